/* Pairs of fields to compare in two frames. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "measure/field-pairs.h"
#include "mesh/grid.h"
#include "stream/declare.h"

static bool listed(const char *const *list, const char *name)
{
	for (int i = 0; list[i]; i++)
		if (!strcmp(list[i], name))
			return true;
	return !list[0];
}

/* Checks that every field, set and mesh named in the options exists. */
static int asked(const struct pm_field_pairs_choice *c, const struct pm_frame *f)
{
	for (int i = 0; c->fields[i]; i++) {
		bool there = false;
		for (size_t k = 0; k < f->nfields; k++)
			there |= !strcmp(f->fields[k]->name, c->fields[i]);
		if (!there)
			return pm_fail(PM_DATA, "no field '%s' in the first stream (sls lists what there is)", c->fields[i]);
	}
	for (int i = 0; c->on[i]; i++)
		if (!pm_frame_set(f, c->on[i]) && !pm_frame_mesh(f, c->on[i]))
			return pm_fail(PM_DATA, "no set or mesh '%s' in the first stream (sls lists what there is)", c->on[i]);
	return 0;
}

/* The fields of one frame must be in the other. */
static int one_sided(const struct pm_field_pairs_choice *c, const struct pm_frame *f, const struct pm_frame *other, const char *which)
{
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *p = f->fields[i];
		if (listed(c->fields, p->name) && listed(c->on, p->on) && !pm_frame_field(other, p->on, p->name))
			return pm_fail(PM_DATA, "'%s' on '%s' is in the %s stream only (--common skips it, --field chooses)", p->name, p->on, which);
	}
	return 0;
}

static int same_shape(const struct pm_frame *f, const struct pm_field *a, const struct pm_frame *g, const struct pm_field *b)
{
	const struct pm_mesh *m = pm_frame_mesh(f, a->on), *k = pm_frame_mesh(g, b->on);
	if (a->components != b->components)
		return pm_fail(PM_DATA, "'%s' on '%s' has %d components in the first stream and %d in the second", a->name, a->on, a->components,
			b->components);
	for (int axis = 0; m && k && axis < f->dim; axis++) {
		if (m->cells[axis] != k->cells[axis])
			return pm_fail(PM_DATA, "the mesh '%s' has %zu cells along %c in the first stream and %zu in the second", a->on, m->cells[axis],
				"xyz"[axis], k->cells[axis]);
		if (fabs(m->lo[axis] - k->lo[axis]) > 1e-9 * m->h[axis] || fabs(m->h[axis] - k->h[axis]) > 1e-9 * m->h[axis])
			return pm_fail(PM_DATA, "the meshes '%s' have different origins along %c", a->on, "xyz"[axis]);
	}
	if (a->count != b->count)
		return pm_fail(PM_DATA, "'%s' has %zu values in the first stream and %zu in the second", a->on, a->count, b->count);
	return memcmp(a->staggered, b->staggered, sizeof a->staggered) ? pm_fail(PM_DATA, "'%s' on '%s' is staggered differently", a->name, a->on) : 0;
}

bool pm_field_pairs_by_id(const struct pm_field_pairs_choice *c, const struct pm_frame *f, const struct pm_frame *g, const char *on)
{
	const struct pm_field *a = pm_frame_field(f, on, "id"), *b = pm_frame_field(g, on, "id");
	return !c->by_index && a && b && pm_frame_set(f, on) && a->type == PM_I64 && b->type == PM_I64;
}

int pm_field_pairs_of(const struct pm_field_pairs_choice *c, struct pm_frame *f, struct pm_frame *g, struct pm_field_pairs *p)
{
	int status = 0;
	p->n = 0;
	if (f->dim != g->dim)
		return pm_fail(PM_DATA, "the first stream has %d dimensions, the second %d", f->dim, g->dim);
	if ((status = asked(c, f)))
		return status;
	if (!c->common && ((status = one_sided(c, f, g, "first")) || (status = one_sided(c, g, f, "second"))))
		return status;
	for (size_t i = 0; i < f->nfields && !status; i++) {
		struct pm_field *a = f->fields[i], *b = pm_frame_field(g, a->on, a->name);
		if (!b || !listed(c->fields, a->name) || !listed(c->on, a->on))
			continue;
		if (p->n == PM_FIELD_PAIRS)
			return pm_fail(PM_DATA, "more than %d fields (choose some with --field)", PM_FIELD_PAIRS);
		status = same_shape(f, a, g, b);
		p->a[p->n] = a, p->b[p->n++] = b;
		a->use |= PM_USE_READ, b->use |= PM_USE_READ;
		if (!status && pm_field_pairs_by_id(c, f, g, a->on))
			pm_reads(f, a->on, "id"), pm_reads(g, a->on, "id");
	}
	if (!status && !p->n)
		return pm_fail(PM_DATA, "there is nothing to compare (sls lists the fields)");
	return status;
}

double *pm_field_pairs_weights(const struct pm_frame *f, const struct pm_field *field)
{
	const struct pm_grid g = pm_grid_of(f, pm_frame_mesh(f, field->on));
	double *w = pm_alloc(field->count + 1, sizeof *w), *o = w;
	for (size_t p = 0; w && p < field->count; p += g.points[0]) {
		const size_t row = ((size_t)field->first + p) / g.points[0];
		for (size_t i = 0; i < g.points[0]; i++)
			*o++ = pm_grid_weight(&g, i, row % g.points[1], row / g.points[1]);
	}
	return w;
}
