/* walk: diffusion by random steps (lib/push/walk-frame.c, random-walk.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include "push/walk-frame.h"
#include "stage/strength-report.h"
#include "stage/viscosity-options.h"

struct config {
	const char *set;
	double nu;
	int64_t seed;
};

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	const struct pm_walk w = {.set = o->set};
	int status = pm_viscosity_check(s, pm_viscosity(f, o->nu));
	if (status || f->substep)
		return status ? status : PM_PASS;
	status = pm_walk_declare(&w, f);
	return status ? status : pm_moving_face(f, PM_PABSORB) ? PM_HOLD : 0;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	const struct pm_walk w = {.set = o->set, .deviation = sqrt(2 * pm_viscosity(f, o->nu) * f->dt),
		.seed = pm_given(s, "seed") ? (uint64_t)o->seed : f->seed};
	for (size_t i = 0; i < f->nsets; i++) {
		uint64_t absorbed = 0;
		struct pm_strengths lost = {.n = 0};
		if (pm_walk_takes(&w, f, f->sets[i]) && pm_walk_set(&w, f, f->sets[i], &absorbed, &lost))
			return -PM_DATA;
		if (absorbed)
			pm_report_count(s, f, "absorbed", absorbed);
		pm_report_strengths(s, f, "absorbed", NULL, &lost);
	}
	pm_report(s, f, "deviation", w.deviation);
	return 0;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return s && f; }

static const struct pm_option options[] = {
	PM_VISCOSITY_ROW,
	{.name = "seed", .kind = PM_INTEGER, .high = 9e15, PM_AT(seed), .text = "seed of the random numbers; by default the frame's"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "only this set; by default every set that moves"},
	{0},
};
static const struct pm_example examples[] = {
	{"a vortex of 2000 blobs spreads, its circulation is conserved",
		"pinit lamb-oseen --cells 48 | cycle -n 3 'p2m | poisson-fft | mgrad | m2p | push midpoint | walk' | diag --columns circulation"},
	{"particles that start at random walk in a box with mirrors",
		"pinit uniform --dim 2 -n 500 --faces wall --particle-faces reflect --dt 0.01 | smod --law free | cycle -n 20 'push drift | walk --nu 0.1' | "
		"sls"},
	{0},
};
const struct pm_tool tool_walk = {
	.name = "walk",
	.summary = "add diffusion by random steps of the particles",
	.about = "x += N(0, 2 nu dt) per component, once per step (inside a step the frame is passed on unchanged): put it after the last push. Strengths "
		"do not "
		"change. The numbers "
		 "depend on seed, set, id (or index, where there is none) and step, not on order or threads; two walks in one sentence need two seeds. "
		 "Fields derived from the positions are dropped. Faces as in push. Error 1/sqrt(N): pse and diffuse are more accurate, but need volumes and "
		 "overlapping particles. Reports the standard deviation of a step and the number of absorbed particles. If nu is 0 the frame is passed on "
		"unchanged. "
		 "See docs/methods/walk.md.",
	.kind = PM_FILTER,
	.reads = "id",
	.changes = "x",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.declare = declare,
	.frame = frame,
	.divided = divided,
};
