/* penalize: a solid body in a flow (lib/vorticity/penalization.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include "fft/axis-transform.h"
#include "stage/plan-option.h"
#include "stage/stage.h"
#include "vorticity/penalization.h"

struct config {
	struct pm_penalization_choice choice;
	const char *plan;
};
struct state {
	struct pm_fft_plans planner;
	struct pm_penalization penalization;
};

static int begin(struct pm_stage *s)
{
	return ((const struct config *)s->config)->choice.body ? 0 : pm_fail(PM_USAGE, "--body EXPRESSION is missing (--body 'hypot(x, y) - 0.5')");
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	return pm_penalization_declare(&((const struct config *)s->config)->choice, f, &((struct state *)s->state)->penalization);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	double force[3];
	int status = pm_penalization_add(&t->penalization, f, &t->planner, force);
	for (int d = 0; d < f->dim && !status; d++)
		pm_report(s, f, (const char *const[]){"force_x", "force_y", "force_z"}[d], force[d]);
	return status;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f)
{
	(void)s;
	return f;
}

static void release(struct pm_stage *s) { pm_fft_plans_clear(&((struct state *)s->state)->planner); }

static const struct pm_option options[] = {
	{.name = "body", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(choice.body),
		.text = "the level of the body at a point of the mesh, a length: below 0 inside. x y z, time and fields of the mesh by name"},
	{.name = "velocity", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(choice.velocity),
		.text = "velocity of the body, one expression an axis with commas between (default: at rest)"},
	{.name = "stream", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(choice.stream),
		.text = "a flow besides that of the vorticity, such as the one that field 'vel = 1, 0' gives the particles"},
	{.name = "rate", .kind = PM_REAL, .unit = "1/time", .low = 0, .high = 1e300, PM_AT(choice.rate),
		.text = "how fast the flow in the body becomes that of the body (default: within a step)"},
	{.name = "edge", .kind = PM_REAL, .unit = "cells", .fallback = "1", .low = 1e-3, .high = 100, PM_AT(choice.width),
		.text = "the body ends smoothly over this distance to both sides of its level 0"},
	{.name = "order", .kind = PM_WORD, .choices = pm_order_names, PM_AT(choice.order),
		.text = "order of the differences, or spectral (default: that of the law's gradients)"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(choice.mesh), .text = "the mesh (default: the first)"},
	{.name = "replace", .kind = PM_FLAG, PM_AT(choice.replace), .text = "replace the change instead of refusing to add it twice"},
	PM_PLAN_ROW,
	{0},
};
static const struct pm_example examples[] = {
	{"the boundary layer and the drag of a cylinder set into motion, a step",
		"pinit taylor-green-2d --cells 32 --speed 0 --dt 0.05 | cycle -n 1 \"p2m | poisson-fft | mgrad | penalize --body 'hypot(x - pi, y - pi) - 1' "
		"--velocity '1, 0' | diffuse | m2p | push lsrk3 | remesh\" | sls --report"},
	{0},
};
const struct pm_tool tool_penalize = {
	.name = "penalize",
	.summary = "put a solid body into a flow: no slip by penalization",
	.about = "d(omega) += curl b, b = chi (u_body - u)/dt on the mesh, as the term penalization, where chi is 1 in the body and 0 outside; with "
		"--rate lambda b = lambda chi (u_body - u)/(1 + lambda dt chi). The vorticity that this takes is the body's boundary layer. Reports "
		"the fluid's force on the body, over the density of the fluid, as force_x, force_y, force_z. See docs/methods/penalize.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "omega and u on the mesh",
	.adds = "domega (mesh), a change of the strength (term penalization)",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
	.free = release,
};
