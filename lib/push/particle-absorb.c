/* Particles that have crossed an absorbing face leave their set. Order is kept. Cost: one pass over every field of the set, and only where one has left.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/particle-faces.h"
#include "push/electrode-charge.h"
#include "push/push-set.h"
#include "stream/declare.h"
#include "stream/join.h"
#include "stream/over-stretches.h"
#include "world/world.h"

bool pm_moving_face(const struct pm_frame *f, enum pm_particle_face face)
{
	for (int a = 0; a < f->dim; a++)
		if (f->pface[a][0] == face || f->pface[a][1] == face)
			return true;
	return false;
}

int pm_moving_shrinks(struct pm_frame *f, const struct pm_moving *m)
{
	for (size_t i = 0, n = f->nfields; i < n; i++) {
		struct pm_field *field = f->fields[i]; /* pm_changes moves a field to the end: use the same index again */
		if (strcmp(field->on, m->set->name) || field->uniform || field->use & (PM_USE_CHANGE | PM_USE_NEW))
			continue;
		if (!pm_changes(f, field->on, field->name))
			return -PM_DATA;
		i--, n--;
	}
	return 0;
}

static size_t mark(const struct pm_frame *f, const struct pm_moving *m, unsigned char *gone)
{
	const size_t n = m->x->count;
	size_t count = 0;
	for (int a = 0; a < f->dim && a < m->x->components; a++) {
		const bool side[2] = {f->pface[a][0] == PM_PABSORB, f->pface[a][1] == PM_PABSORB};
		if (side[0] || side[1])
			pm_particle_faces_absorb(n, f->lo[a], f->hi[a], side, pm_in(m->x, a), gone);
	}
	for (size_t i = 0; i < n; i++)
		count += gone[i];
	return count;
}

struct leaving {
	const unsigned char *gone;
	const double *q;
};

static void make(const void *data, size_t from, size_t to, void *part)
{
	const struct leaving *l = data;
	for (size_t p = from; p < to; p++)
		if (l->gone[p])
			pm_sum_add(part, l->q[p]);
}

/* The sums of the strengths of the particles that leave. */
static void note_loss(const struct pm_frame *f, const struct pm_moving *m, const unsigned char *gone, uint64_t absorbed, struct pm_strengths *lost)
{
	const struct pm_parts parts = {.size = sizeof(struct pm_sum), .make = make, .join = pm_join_sums};
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *field = f->fields[i];
		for (int c = 0; !strcmp(field->on, m->set->name) && pm_is_strength(field) && c < field->components && lost->n < PM_STRENGTHS; c++) {
			struct pm_strength *one = &lost->of[lost->n++];
			struct pm_sum sum = {0, 0};
			if (!field->uniform)
				pm_over_stretches(field, &parts, &(struct leaving){gone, pm_in(field, c)}, &sum);
			pm_strength_name(field, c, one->name);
			one->sum = field->uniform ? (double)absorbed * field->value[c] : pm_sum_total(sum);
		}
	}
}

int pm_moving_absorb(struct pm_frame *f, const struct pm_moving *m, uint64_t *absorbed, struct pm_strengths *lost)
{
	const size_t n = m->x->count;
	unsigned char *gone = pm_zalloc(n ? n : 1, 1);
	int64_t all = gone ? (int64_t)mark(f, m, gone) : 0;
	int status = pm_world_count(gone ? 0 : -PM_DATA, PM_SUM_OF, 1, &all);
	*absorbed = (uint64_t)all;
	lost->n = 0;
	if (!status && all) {
		note_loss(f, m, gone, *absorbed, lost);
		pm_electrodes_collect(f, m->set->name);
		for (size_t i = 0; i < n; i++)
			gone[i] = !gone[i];
		status = pm_frame_select(f, m->set, gone); /* now those that stay */
	}
	pm_free(gone);
	return status;
}
