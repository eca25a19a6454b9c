/* reproject: the divergence of the vorticity removed from the strengths (lib/vorticity/reprojection.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include "fft/axis-transform.h"
#include "stage/stage.h"
#include "stage/strength-report.h"
#include "vorticity/reprojection.h"

struct config {
	struct pm_reprojection_choice choice;
	int64_t every;
};
struct state {
	struct pm_fft_plans plans;
	struct pm_fft_solvers solvers;
	struct pm_reprojection reprojection;
};

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	if (f->substep || f->step % o->every)
		return PM_PASS;
	if (f->dim < 3)
		return pm_idle(s, "in the plane the vorticity has no divergence");
	return pm_reprojection_declare(&o->choice, f, &((struct state *)s->state)->reprojection);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	struct pm_strengths before, after;
	double divergence = 0;
	pm_strengths_of(f, NULL, &before);
	const int done = pm_reprojection_apply(&t->reprojection, f, &t->plans, &t->solvers, &divergence);
	if (done < 0)
		return done;
	pm_strengths_of(f, NULL, &after);
	pm_report(s, f, "divergence", divergence);
	if (done) {
		pm_report_count(s, f, "reprojections", 1);
		pm_report_strengths(s, f, "given", &before, &after);
	}
	return 0;
}

static void release(struct pm_stage *s)
{
	struct state *t = s->state;
	pm_fft_solvers_clear(&t->solvers);
	pm_fft_plans_clear(&t->plans);
}

static const struct pm_option options[] = {
	{.name = "kernel", .letter = 'k', .kind = PM_WORD, .choices = pm_kernel_names, PM_AT(choice.kernel),
		.text = "the interpolation kernel (default: the law's)"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(choice.mesh), .text = "the mesh (default: the first)"},
	{.name = "order", .kind = PM_WORD, .choices = pm_order_names, PM_AT(choice.order),
		.text = "order of divergence and gradient (default: spectral; 6 where a face is open)"},
	{.name = "passes", .kind = PM_INTEGER, .fallback = "1", .low = 1, .high = 1000, PM_AT(choice.passes),
		.text = "of differences: each removes what the one before left near the mesh's own wave length"},
	{.name = "every", .kind = PM_INTEGER, .unit = "steps", .fallback = "1", .low = 1, .high = 1e15, PM_AT(every),
		.text = "act only if the step number is a multiple of this"},
	{.name = "above", .kind = PM_REAL, .fallback = "0", .high = 1e9, PM_AT(choice.above),
		.text = "act only if max |div omega| h/max |omega| is above this"},
	{0},
};
static const struct pm_example examples[] = {
	{"vortices in space whose divergence is kept below 1 % of the largest vorticity in a cell",
		"pinit taylor-green-3d --cells 16 | "
		"cycle -n 2 'p2m | poisson-fft | mgrad | stretch | m2p | push lsrk3 | remesh | reproject --above 0.01' | sls"},
	{0},
};
const struct pm_tool tool_reproject = {
	.name = "reproject",
	.summary = "remove the divergence of the vorticity of particles in space",
	.about = "alpha -= volume grad chi, lap chi = div omega, omega that of the particles on the mesh. Put it behind remesh, with its kernel: on nodes the "
		"result is exact. Acts between steps only; inside a step, and in the plane, the frame is passed on unchanged. Reports the divergence found, as "
		"diag measures it, and what it adds to the total (given_alpha). See docs/methods/reproject.md.",
	.kind = PM_FILTER,
	.reads = "x, alpha and volume",
	.changes = "alpha",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.declare = declare,
	.frame = frame,
	.free = release,
};
