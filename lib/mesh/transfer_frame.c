/* Transfers between the sets and the meshes of a frame.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "mesh/transfer_frame.h"

enum { grow_block = 8 }; /* cells */

static bool is_real(const struct pm_field *field) { return field->type == PM_F64 || field->type == PM_F32; }

int pm_reads_positions(struct pm_frame *f, const char *set)
{
	const struct pm_field *x = pm_frame_field(f, set, "x");
	if (!x || x->components < f->dim || !is_real(x))
		return pm_fail(PM_DATA, "no positions 'x' of %d real components on '%s' (stab reads them from a table)", f->dim, set);
	return pm_reads(f, set, "x") ? 0 : -PM_DATA;
}

void pm_positions(const struct pm_frame *f, const char *set, const double *x[3])
{
	for (int d = 0; d < f->dim; d++)
		x[d] = pm_in(pm_frame_field(f, set, "x"), d);
}

int pm_reads_strength(struct pm_frame *f, const char *set, const char *name)
{
	const struct pm_field *q = pm_frame_field(f, set, name), *volume = pm_frame_field(f, set, "volume");
	if (!q)
		return pm_fail(PM_DATA, "no field '%s' on '%s' (add it with stab --strength, or choose another with --strength FIELD)", name, set);
	if (!is_real(q))
		return pm_fail(PM_DATA, "'%s' on '%s' is of type %s, not real (scalc makes a real field of it)", name, set, pm_type_names[q->type]);
	if (!q->extensive && (!volume || !is_real(volume)))
		return pm_fail(PM_DATA, "'%s' on '%s' is a value, not a strength, and there is no 'volume' to multiply it by (scalc makes one)", name, set);
	if (!pm_reads(f, set, name) || (!q->extensive && !pm_reads(f, set, "volume")))
		return -PM_DATA;
	return 0;
}

int pm_strengths(const struct pm_frame *f, const char *set, const char *name, const double *q[], double **made)
{
	const struct pm_field *strength = pm_frame_field(f, set, name);
	size_t n = strength->count;
	*made = NULL;
	for (int c = 0; c < strength->components; c++)
		q[c] = pm_in(strength, c);
	if (strength->extensive)
		return 0;
	const double *volume = pm_in(pm_frame_field(f, set, "volume"), 0);
	*made = pm_alloc(n * (size_t)strength->components, sizeof **made);
	if (!*made)
		return -PM_DATA;
	for (int c = 0; c < strength->components; c++) {
		double *to = *made + (size_t)c * n;
		for (size_t p = 0; p < n; p++)
			to[p] = q[c][p] * volume[p];
		q[c] = to;
	}
	return 0;
}

int pm_ratio(const struct pm_frame *f, const char *set, const char *strength, const char *per, double **ratio)
{
	const struct pm_field *top = pm_frame_field(f, set, strength);
	const double *q = pm_in(top, 0), *m = pm_in(pm_frame_field(f, set, per), 0);
	*ratio = pm_alloc(top->count, sizeof **ratio);
	if (!*ratio)
		return -PM_DATA;
	for (size_t p = 0; p < top->count; p++) {
		if (m[p] == 0)
			return pm_fail(PM_DATA, "'%s' of particle %zu of '%s' is 0: %s/%s is not defined", per, p, set, strength, per);
		(*ratio)[p] = q[p] / m[p];
	}
	return 0;
}

int pm_strays_refuse(const struct pm_strays *s, const char *set, const struct pm_mesh *m, const struct pm_transfer *t, const char *remedy)
{
	char at[96] = "";
	int d = s->axis, dim = t->grid.dim;
	double low = m->lo[d], high = m->lo[d] + (double)m->cells[d] * m->h[d];
	for (int c = 0, used = 0; c < dim; c++)
		used += snprintf(at + used, sizeof at - (size_t)used, "%s%.6g", c ? ", " : "", s->x[c]);
	if (s->x[d] >= low && s->x[d] <= high)
		return pm_fail(PM_DATA, "particle %zu of '%s' at (%s) is too near the open face %c = %g of mesh '%s': the support of %s must stay inside (%s)",
			s->first, set, at, "xyz"[d], s->x[d] - low < high - s->x[d] ? low : high, m->name, t->kernel->name, remedy);
	return pm_fail(PM_DATA, "particle %zu of '%s' at (%s) is outside mesh '%s', %g <= %c <= %g (%s)", s->first, set, at, m->name, low, "xyz"[d],
		high, remedy);
}

int pm_mesh_fit(const struct pm_frame *f, const struct pm_mesh *m, const struct pm_transfer *t, size_t nsets, const char *const *sets, size_t cells[3],
	double lo[3])
{
	size_t need[2][3] = {{0}};
	int grown = 0;
	for (size_t i = 0; i < nsets; i++) {
		const double *x[3];
		size_t here[2][3];
		pm_positions(f, sets[i], x);
		int status = pm_transfer_grow(t, pm_frame_set(f, sets[i])->n, x, here[0], here[1]);
		if (status)
			return status;
		for (int side = 0; side < 2; side++)
			for (int d = 0; d < f->dim; d++)
				need[side][d] = here[side][d] > need[side][d] ? here[side][d] : need[side][d];
	}
	for (int d = 0; d < f->dim; d++) {
		size_t below = (need[0][d] + grow_block - 1) / grow_block * grow_block, above = (need[1][d] + grow_block - 1) / grow_block * grow_block;
		cells[d] = m->cells[d] + below + above;
		lo[d] = m->lo[d] - (double)below * m->h[d];
		grown |= below || above;
	}
	return grown;
}
