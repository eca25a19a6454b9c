/* Particles that have crossed an absorbing face leave their set. Order is kept. Cost: one pass over every field of the set, and only where one has left.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "base/in-order.h"
#include "mesh/particle-faces.h"
#include "push/electrode-charge.h"
#include "push/push-set.h"
#include "stream/declare.h"

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
	size_t n = m->set->n, count = 0;
	for (int a = 0; a < f->dim && a < m->x->components; a++) {
		const bool side[2] = {f->pface[a][0] == PM_PABSORB, f->pface[a][1] == PM_PABSORB};
		if (side[0] || side[1])
			pm_particle_faces_absorb(n, f->lo[a], f->hi[a], side, pm_in(m->x, a), gone);
	}
	for (size_t i = 0; i < n; i++)
		count += gone[i];
	return count;
}

/* Moves the values with gone 0 to the front, in order; size bytes each. Returns their number. */
static size_t compact(size_t n, const unsigned char *gone, size_t size, void *values)
{
	unsigned char *p = values;
	size_t left = 0;
	for (size_t i = 0; i < n; i++)
		if (!gone[i]) {
			if (left != i)
				memcpy(p + left * size, p + i * size, size);
			left++;
		}
	return left;
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
			if (field->buffer)
				pm_over_set(&parts, &(struct leaving){gone, pm_in(field, c)}, field->count, &sum);
			pm_strength_name(field, c, one->name);
			one->sum = field->buffer ? pm_sum_total(sum) : (double)absorbed * field->value[c];
		}
	}
}

int pm_moving_absorb(struct pm_frame *f, const struct pm_moving *m, uint64_t *absorbed, struct pm_strengths *lost)
{
	size_t n = m->set->n;
	unsigned char *gone = pm_zalloc(n ? n : 1, 1);
	if (!gone)
		return -PM_DATA;
	*absorbed = mark(f, m, gone);
	lost->n = 0;
	if (*absorbed) {
		note_loss(f, m, gone, *absorbed, lost);
		pm_electrodes_collect(f, m->set->name);
	}
	for (size_t i = 0; i < f->nfields && *absorbed; i++) {
		struct pm_field *field = f->fields[i];
		unsigned char *bytes = strcmp(field->on, m->set->name) ? NULL : pm_field_bytes(field);
		size_t size = field->type == PM_U8 ? 1 : 8;
		for (int c = 0; bytes && c < field->components; c++)
			compact(n, gone, size, bytes + (size_t)c * n * size);
	}
	pm_free(gone);
	return *absorbed ? pm_frame_set_resize(f, m->set, n - *absorbed) : 0; /* keeps the first values of every component */
}
