/* Random walk of the sets of a frame: the sets that walk, the fields changed, one step (random-walk.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "push/random-walk.h"
#include "push/walk-frame.h"
#include "stream/declare.h"

bool pm_walk_takes(const struct pm_walk *w, const struct pm_frame *f, const struct pm_set *set)
{
	return pm_set_moves(f, set) && (!w->set || !strcmp(w->set, set->name));
}

static int declare_set(struct pm_frame *f, struct pm_set *set)
{
	const struct pm_field *x = pm_frame_field(f, set->name, "x"), *id = pm_frame_field(f, set->name, "id");
	struct pm_moving m = {.set = set};
	if (x->components < f->dim)
		return pm_fail(PM_DATA, "the positions of '%s' have %d components in %d-D", set->name, x->components, f->dim);
	if (id && id->type != PM_I64)
		return pm_fail(PM_DATA, "'id' on '%s' is not i64, but the random numbers depend on it (smod --rename id=NAME)", set->name);
	if (!pm_changes(f, set->name, "x") || (id && !pm_reads(f, set->name, "id")))
		return -PM_DATA;
	pm_drops_roles(f, set->name, 1u << PM_CHANGE | 1u << PM_DERIVED);
	return pm_moving_face(f, PM_PABSORB) ? pm_moving_shrinks(f, &m) : 0;
}

int pm_walk_declare(const struct pm_walk *w, struct pm_frame *f)
{
	int sets = 0, status = 0;
	if (!(f->dt > 0))
		return pm_fail(PM_DATA, "the time step is %g, but a walk needs 2 nu dt > 0 (smod --dt, or the word dt)", f->dt);
	for (size_t i = 0; i < f->nsets && !status; i++)
		if (pm_walk_takes(w, f, f->sets[i])) {
			status = declare_set(f, f->sets[i]);
			sets++;
		}
	if (!status && !sets)
		return f->nsets ? pm_fail(PM_DATA, "no set that moves%s%s (a set with positions 'x' that is not fixed; sls lists the sets)",
			w->set ? " is called " : "", w->set ? w->set : "") : pm_fail(PM_DATA, "no particles (species, stab and pinit make them)");
	pm_drops_roles(f, NULL, 1u << PM_CHANGE | 1u << PM_DERIVED);
	return status;
}

int pm_walk_set(const struct pm_walk *w, struct pm_frame *f, struct pm_set *set, uint64_t *absorbed, struct pm_strengths *lost)
{
	struct pm_moving m = {.set = set, .x = pm_frame_field(f, set->name, "x")};
	const struct pm_field *id = pm_frame_field(f, set->name, "id");
	double *x[3] = {NULL};
	for (int d = 0; d < f->dim; d++)
		x[d] = pm_out(m.x, d);
	pm_walk_step(pm_walk_key(w->seed, set->name), f->step, w->deviation, m.x->first, m.x->count, f->dim, id ? pm_in_i64(id, 0) : NULL, x);
	pm_walk_faces(f, m.x->count, x);
	*absorbed = 0;
	lost->n = 0;
	return pm_moving_face(f, PM_PABSORB) && pm_moving_absorb(f, &m, absorbed, lost) ? -PM_DATA : 0;
}
