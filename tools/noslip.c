/* noslip: walls without slip in a viscous plane flow (lib/panels/). SPDX-License-Identifier: GPL-3.0-or-later */
#include "panels/noslip-frame.h"
#include "stage/viscosity-options.h"

struct config {
	struct pm_panels_choice choice;
	double nu;
	int64_t n;
};
struct state {
	struct pm_noslip_job job;
	struct pm_panels_solver solver;
};

static int begin(struct pm_stage *s)
{
	struct config *o = s->config;
	o->choice.n = (size_t)o->n;
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct state *t = s->state;
	if (f->substep)
		return PM_PASS;
	t->job.nu = pm_viscosity(f, o->nu);
	int status = pm_noslip_law(f);
	if (!status)
		status = pm_viscosity_check(s, t->job.nu);
	return status ? status : pm_noslip_declare(&o->choice, f, &t->job);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	struct pm_noslip_done done;
	int status = pm_noslip_apply(&((const struct config *)s->config)->choice, f, &t->job, &t->solver, &done);
	if (status)
		return status;
	pm_report(s, f, "slip", done.slip);
	pm_report(s, f, "force_x", done.force[0]);
	pm_report(s, f, "force_y", done.force[1]);
	pm_report(s, f, "torque", done.torque);
	pm_report_sum(s, f, "given_circulation", done.given);
	pm_report_count(s, f, "plain", done.plain);
	return 0;
}

static void release(struct pm_stage *s) { pm_panels_solver_free(&((struct state *)s->state)->solver); }

static const struct pm_option options[] = {
	{.name = "curve", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(choice.curve),
		.text = "the wall, counter-clockwise: x and y of s = 0 to 1 with a comma between, closed, also of time (default: the corners are in the set)"},
	{.name = "pieces", .letter = 'n', .kind = PM_INTEGER, .unit = "panels", .fallback = "200", .low = 3, .high = 20000, PM_AT(n),
		.text = "panels of the curve, at equal steps of s"},
	{.name = "stream", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(choice.stream),
		.text = "a flow besides that of the vorticity at x y, such as the one that field 'vel = 1, 0' gives the particles"},
	{.name = "velocity", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(choice.velocity),
		.text = "of the wall at x y and time, rigid: '-2*y, 2*x' turns (default: at rest)"},
	{.name = "circulation", .kind = PM_REAL, .unit = "length^2/time", .fallback = "0", .low = -1e300, .high = 1e300, PM_AT(choice.circulation),
		.text = "of the whole flow far away"},
	PM_VISCOSITY_ROW,
	{.name = "panels", .kind = PM_TEXT, .unit = "NAME", .fallback = "panels", PM_AT(choice.name), .text = "the set of panels"},
	{0},
};
static const struct pm_example examples[] = {
	{"the drag of a cylinder that a stream meets suddenly, after 10 steps",
		"pinit cylinder --cells 64x48 --dt 0.01 | sel --where 'hypot(x, y) > 0.5001' | cycle -q -n 10 \"noslip --curve '0.5*cos(2*pi*s), "
		"0.5*sin(2*pi*s)' -n 50 --stream '1, 0' | p2m | poisson-fft | mgrad | m2p | field 'vel = 1, 0' | push rk2 | "
		"remesh --mask 'hypot(x, y) <= 0.5001' --rim 4\" | sls --report"},
	{0},
};
const struct pm_tool tool_noslip = {
	.name = "noslip",
	.summary = "walls without slip: the vorticity that a wall gives to a viscous plane flow",
	.about = "The viscous part of a step, for particles on the nodes of the mesh (behind remesh --mask BODY; in place of diffuse): diffusion "
		"without flux through the wall, then the vortex sheet that is the slip left at the wall enters the fluid as a flux of vorticity. The "
		"circulation at infinity stays to round-off. Reports the slip, the force and torque on the body over the fluid's density. "
		"See docs/methods/noslip.md.",
	.kind = PM_FILTER,
	.reads = "x, circulation",
	.changes = "circulation",
	.adds = "the set panels",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.free = release,
};
