/* walk: diffusion by random steps (lib/push/random-walk.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "stage/stage.h"
#include "push/push-set.h"
#include "push/random-walk.h"

struct config {
	const char *set;
	double nu;
	int64_t seed;
};

static double viscosity(const struct config *o, const struct pm_frame *f) { return isnan(o->nu) ? pm_frame_constant(f, "nu", 0) : o->nu; }

static bool walks(const struct config *o, const struct pm_frame *f, const struct pm_set *set)
{
	return pm_set_moves(f, set) && (!o->set || !strcmp(o->set, set->name));
}

/* What a set's walk changes, and what no longer belongs to its positions. */
static int plan_set(struct pm_frame *f, struct pm_set *set)
{
	const struct pm_field *x = pm_frame_field(f, set->name, "x"), *id = pm_frame_field(f, set->name, "id");
	struct pm_moving m = {.set = set};
	if (x->components < f->dim)
		return pm_fail(PM_DATA, "the positions of '%s' have %d components in %d-D", set->name, x->components, f->dim);
	if (id && id->type != PM_I64)
		return pm_fail(PM_DATA, "'id' on '%s' is not i64, and whose step is which depends on it (smod --rename id=NAME)", set->name);
	if (!pm_changes(f, set->name, "x") || (id && !pm_reads(f, set->name, "id")))
		return -PM_DATA;
	pm_drops_roles(f, set->name, 1u << PM_CHANGE | 1u << PM_DERIVED);
	return pm_moving_face(f, PM_PABSORB) ? pm_moving_shrinks(f, &m) : 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	double nu = viscosity(o, f);
	int sets = 0, status = 0;
	if (!(nu >= 0))
		return pm_fail(PM_DATA, "the viscosity nu is %g: negative diffusion has no solution (--nu, or the scene's)", nu);
	if (nu == 0)
		return pm_idle(s, "the viscosity nu is 0");
	if (f->substep)
		return PM_PASS;
	if (!(f->dt > 0))
		return pm_fail(PM_DATA, "the time step is %g, and a walk takes 2 nu dt > 0 (smod --dt, or the word dt)", f->dt);
	for (size_t i = 0; i < f->nsets && !status; i++)
		if (walks(o, f, f->sets[i])) {
			status = plan_set(f, f->sets[i]);
			sets++;
		}
	if (!status && !sets)
		return pm_fail(PM_DATA, "no set that moves%s%s (a set with positions 'x' that is not "
			"fixed)", o->set ? " is called " : "", o->set ? o->set : "");
	pm_drops_roles(f, NULL, 1u << PM_CHANGE | 1u << PM_DERIVED);
	return status ? status : pm_moving_face(f, PM_PABSORB) ? PM_HOLD : 0;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	uint64_t seed = pm_given(s, "seed") ? (uint64_t)o->seed : f->seed;
	double deviation = sqrt(2 * viscosity(o, f) * f->dt);
	for (size_t i = 0; i < f->nsets; i++) {
		struct pm_set *set = f->sets[i];
		if (!walks(o, f, set))
			continue;
		struct pm_moving m = {.set = set, .x = pm_frame_field(f, set->name, "x")};
		const struct pm_field *id = pm_frame_field(f, set->name, "id");
		double *x[3] = {NULL};
		uint64_t absorbed = 0;
		for (int d = 0; d < f->dim; d++)
			x[d] = pm_out(m.x, d);
		pm_walk_step(pm_walk_key(seed, set->name), f->step, deviation, set->n, f->dim, id ? pm_in_i64(id, 0) : NULL, x);
		pm_walk_faces(f, set->n, x);
		if (pm_moving_face(f, PM_PABSORB) && pm_moving_absorb(f, &m, &absorbed))
			return -PM_DATA;
		if (absorbed)
			pm_report_count(s, f, "absorbed", absorbed);
	}
	pm_report(s, f, "deviation", deviation);
	return 0;
}

static const struct pm_option options[] = {
	{.name = "nu", .kind = PM_REAL, .unit = "length^2/time", .high = 1e300, PM_AT(nu), .text = "the viscosity (default: the frame's constant nu)"},
	{.name = "seed", .kind = PM_INTEGER, .high = 9e15, PM_AT(seed), .text = "of the random numbers; by default the frame's"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "only this set; by default every set that moves"},
	{0},
};
static const struct pm_example examples[] = {
	{"a vortex of 2000 blobs spreads, its circulation stays",
		"pinit lamb-oseen --cells 48 | cycle -n 3 'p2m | poisson-fft | mgrad | m2p | push rk2 | walk' | diag --columns circulation"},
	{"particles that start at random walk in a box with mirrors",
		"pinit uniform --dim 2 -n 500 --faces wall --particle-faces reflect --dt 0.01 | smod --law free | cycle -n 20 'push drift | walk --nu 0.1' | "
		"sls"},
	{0},
};
const struct pm_tool tool_walk = {
	.name = "walk",
	.summary = "add diffusion by random steps of the particles",
	.about = "x += N(0, 2 nu dt) per component, once per step (in the middle of one the frame passes): put it behind the last push. Strengths do not "
		"change. The numbers "
		 "depend on seed, set, id (or index, where there is none) and step, not on order or threads; two walks in one sentence need two seeds. "
		 "Moving drops what was "
		 "derived from the positions. Faces as in push. Error 1/sqrt(N): pse and diffuse are more exact, and need volumes and overlap, which this "
		 "does not. Reports the standard "
		 "deviation of a step and what is absorbed. Where nu is 0 the frame passes. See docs/methods/walk.md.",
	.kind = PM_FILTER,
	.reads = "id",
	.changes = "x",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.declare = declare,
	.frame = frame,
};
