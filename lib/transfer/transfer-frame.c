/* Transfers between the sets and the meshes of a frame: the sets involved, the fields read and made, the growth of a mesh, errors for strays.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "mesh/regrid.h"
#include "transfer/transfer-frame.h"
#include "stream/declare.h"
#include "stream/field-value.h"
#include "stream/column.h"
#include "stream/kept.h"
#include "world/world.h"

enum { grow_block = 8 }; /* cells */

static bool is_real(const struct pm_field *field) { return field->type == PM_F64 || field->type == PM_F32; }

/* The first field of needs[] that the set has not, or only as a change or register; NULL if it has all. */
static const char *lacks(const struct pm_frame *f, const char *set, const char *const needs[])
{
	for (int i = 0; needs[i]; i++) {
		const struct pm_field *field = pm_frame_field(f, set, needs[i]);
		if (!field || field->role == PM_CHANGE || field->role == PM_REGISTER)
			return needs[i];
	}
	return NULL;
}

int pm_sets_choose(const struct pm_frame *f, const char *only, const char *const needs[], const char *remedy, struct pm_sets *sets)
{
	sets->n = 0;
	for (size_t i = 0; i < f->nsets && sets->n < PM_SETS_MOST; i++) {
		const char *name = f->sets[i]->name, *missing = lacks(f, name, needs);
		if (only && !strcmp(name, only) && missing)
			return pm_fail(PM_DATA, "no field '%s' on '%s' (%s)", missing, name, remedy);
		if (!missing && (!only || !strcmp(name, only)))
			sets->name[sets->n++] = name;
	}
	if (sets->n)
		return 0;
	if (only)
		return pm_fail(PM_DATA, "no set '%s' (sls lists them)", only);
	if (!f->nsets)
		return pm_fail(PM_DATA, "the frame has no particles (species, stab and pinit make them; species NAME -n 0: a set for a vacuum)");
	const char *missing = f->nsets == 1 ? lacks(f, f->sets[0]->name, needs) : needs[0];
	if (f->nsets == 1)
		return pm_fail(PM_DATA, "no field '%s' on '%s' (%s)", missing, f->sets[0]->name, remedy);
	char list[PM_NAME * 4] = "";
	for (size_t i = 0, used = 0; needs[i] && used < sizeof list; i++)
		used += (size_t)snprintf(list + used, sizeof list - used, "%s'%s'", i ? ", " : "", needs[i]);
	return pm_fail(PM_DATA, "no set has %s (%s)", list, remedy);
}

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

bool pm_ratio_is_one(const struct pm_frame *f, const char *set, const char *strength, const char *per, double *ratio)
{
	const struct pm_field *top = pm_frame_field(f, set, strength), *bottom = pm_frame_field(f, set, per);
	const bool one = pm_value_is_one(top) && pm_value_is_one(bottom) && bottom->value[0] != 0;
	*ratio = one ? top->value[0] / bottom->value[0] : 1;
	return one;
}

int pm_ratio(const struct pm_frame *f, const char *set, const char *strength, const char *per, const double **ratio, double **made)
{
	static const char name[] = "quotient of strengths";
	const struct pm_field *top = pm_frame_field(f, set, strength), *bottom = pm_frame_field(f, set, per);
	const struct pm_column q = pm_column_of(top, 0), m = pm_column_of(bottom, 0);
	*made = NULL;
	if ((*ratio = pm_kept(top, bottom, name)))
		return 0;
	*ratio = *made = pm_alloc(top->count, sizeof **made);
	if (!*made)
		return -PM_DATA;
	for (size_t p = 0; p < top->count; p++) {
		if (pm_column_at(&m, p) == 0) {
			pm_world_place(2, 0, 0, top->first + p);
			return pm_fail(PM_DATA, "'%s' of particle %zu of '%s' is 0: %s/%s is not defined", per, (size_t)top->first + p, set, strength, per);
		}
		(*made)[p] = pm_column_at(&q, p) / pm_column_at(&m, p);
	}
	if (pm_keep(top, bottom, name, *made))
		*made = NULL;
	return 0;
}

void pm_ratio_range(const struct pm_frame *f, const char *set, const char *strength, const char *per, const double *ratio, double range[2])
{
	static const char name[] = "range of quotients of strengths";
	const struct pm_field *top = pm_frame_field(f, set, strength), *bottom = pm_frame_field(f, set, per);
	const double *kept = pm_kept(top, bottom, name);
	const size_t n = top->count;
	double *keep, least = INFINITY, most = -INFINITY;
#pragma omp parallel for schedule(static) reduction(min : least) reduction(max : most) if (!kept && n > pm_many_turns())
	for (size_t p = 0; p < (kept ? 0 : n); p++) {
		least = fmin(least, ratio[p]);
		most = fmax(most, ratio[p]);
	}
	range[0] = kept ? kept[0] : least, range[1] = kept ? kept[1] : most;
	if (!kept && (keep = pm_alloc(2, sizeof *keep))) {
		keep[0] = least, keep[1] = most;
		if (!pm_keep(top, bottom, name, keep))
			pm_free(keep);
	}
}

/* To so many digits that it does not look like the face it is beyond. */
static int digits_apart(double x, double low, double high)
{
	const double face = x < low ? low : high;
	char a[32], b[32];
	int digits = 6;
	do {
		snprintf(a, sizeof a, "%.*g", digits, x);
		snprintf(b, sizeof b, "%.*g", digits, face);
	} while (!strcmp(a, b) && ++digits < 17);
	return digits;
}

int pm_strays_refuse(const struct pm_strays *s, const char *set, const struct pm_mesh *m, const struct pm_transfer *t, const char *remedy)
{
	char at[96] = "";
	int d = s->axis, dim = t->grid.dim;
	double low = m->lo[d], high = m->lo[d] + (double)m->cells[d] * m->h[d];
	pm_world_place(2, 0, 0, s->first);
	for (int c = 0, used = 0; c < dim; c++)
		used += snprintf(at + used, sizeof at - (size_t)used, "%s%.*g", c ? ", " : "", c == d ? digits_apart(s->x[c], low, high) : 6, s->x[c]);
	if (s->x[d] >= low && s->x[d] <= high)
		return pm_fail(PM_DATA, "particle %zu of '%s' at (%s) is too near the open face %c = %g of mesh '%s': the support of %s must stay inside (%s)",
			s->first, set, at, "xyz"[d], s->x[d] - low < high - s->x[d] ? low : high, m->name, t->kernel->name, remedy);
	return pm_fail(PM_DATA, "particle %zu of '%s' at (%s) is outside mesh '%s', %g <= %c <= %g (%s)", s->first, set, at, m->name, low, "xyz"[d],
		high, remedy);
}

/* As pm_transfer_grow; with other ranks of the corners of the box around all particles, which decide. */
static int grow_set(const struct pm_frame *f, const struct pm_transfer *t, const char *set, size_t need[2][3])
{
	const struct pm_field *positions = pm_frame_field(f, set, "x");
	const double *x[3];
	double most[6], corner[3][2];
	pm_positions(f, set, x);
	if (!positions->here)
		return pm_transfer_grow(t, positions->count, x, need[0], need[1]);
	for (int d = 0; d < f->dim; d++) {
		most[2 * d] = most[2 * d + 1] = -INFINITY;
		for (size_t p = 0; p < positions->count; p++) {
			most[2 * d] = fmax(most[2 * d], -x[d][p]);
			most[2 * d + 1] = fmax(most[2 * d + 1], x[d][p]);
		}
	}
	const int status = pm_world_largest(0, 2 * (size_t)f->dim, most);
	for (int d = 0; d < f->dim; d++) {
		corner[d][0] = -most[2 * d], corner[d][1] = most[2 * d + 1];
		x[d] = corner[d];
	}
	return status ? status : pm_transfer_grow(t, isfinite(most[0]) ? 2 : 0, x, need[0], need[1]);
}

int pm_mesh_grow(struct pm_frame *f, struct pm_mesh *m, const struct pm_transfer *t, const struct pm_sets *sets)
{
	size_t need[2][3] = {{0}}, cells[3] = {1, 1, 1};
	double lo[3];
	bool grown = false;
	for (size_t i = 0; i < sets->n; i++) {
		size_t here[2][3];
		int status = grow_set(f, t, sets->name[i], here);
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
		grown = grown || below || above;
	}
	if (!grown)
		return 0;
	/* Once more: places on the other side may be rounded to beyond the last ones, seen from the new corner. */
	int status = pm_mesh_regrid(f, m, cells, lo, m->h);
	struct pm_transfer larger = *t;
	larger.grid = pm_grid_of(f, m);
	status = status ? status : pm_mesh_grow(f, m, &larger, sets);
	return status < 0 ? status : 1;
}

const struct pm_kernel *pm_kernel_choose(const char *option, const struct pm_field *field, const struct pm_law *law, const char *otherwise)
{
	return pm_kernel_find(option ? option : field && *field->kernel ? field->kernel : law->kernel ? law->kernel : otherwise);
}

/* Fails if the strength has not the same shape on every set, or the old density cannot be replaced or added to. */
static int check_density(const struct pm_frame *f, const struct pm_field *old, const struct pm_density *d, bool add)
{
	const struct pm_sets *sets = d->sets;
	int components = pm_frame_field(f, sets->name[0], d->strength)->components;
	for (size_t i = 1; i < sets->n; i++)
		if (pm_frame_field(f, sets->name[i], d->strength)->components != components)
			return pm_fail(PM_DATA, "'%s' has not the same number of components on '%s' and '%s' (choose one with --set)", d->strength,
				sets->name[0], sets->name[i]);
	if (old && old->role != PM_DERIVED)
		return pm_fail(PM_DATA, "'%s' on '%s' is %s, which a density does not replace (choose another name with --field)", old->name, old->on,
			pm_role_names[old->role]);
	if (old && add && (old->components != components || strcmp(old->kernel, d->kernel->name) || old->interlaced != d->interlaced))
		return pm_fail(PM_DATA, "'%s' on '%s' has %d components and the kernel '%s'%s; %d of '%s'%s cannot be added to it (leave out --add)", old->name,
			old->on, old->components, old->kernel, old->interlaced ? " interlaced" : "", components, d->kernel->name,
			d->interlaced ? " interlaced" : "");
	if (old && add && old->rim != d->rim)
		return pm_fail(PM_DATA, "'%s' on '%s' was deposited with a rim of %d cells (--rim %d)", old->name, old->on, old->rim, old->rim);
	return 0;
}

/* mass: mass/length^3; length^2/time in the plane: 1/time. */
static void unit_over_volume(const char *unit, int dim, char *out, size_t size)
{
	char volume[16];
	int n = snprintf(volume, sizeof volume, "length^%d", dim);
	if (!strncmp(unit, volume, (size_t)n) && unit[n] == '/')
		snprintf(out, size, "1%.40s", unit + n);
	else if (*unit)
		snprintf(out, size, dim > 1 ? "%.40s/%s" : "%.40s/length", unit, volume);
}

static bool is_term(const struct pm_field *field, const char *name)
{
	for (int i = 0; i < field->nterms; i++)
		if (!strcmp(field->terms[i], name))
			return true;
	return false;
}

/* Which sets the density is made of, for m2p: their names, none if these are all that have the strength. One added twice, or more than there is room for:
 * what is beyond the mesh is then refused. */
static int mark_sources(struct pm_frame *f, const struct pm_density *d, bool added, struct pm_field *density)
{
	struct pm_sets all;
	int status = pm_sets_choose(f, NULL, (const char *const[]){d->strength, NULL}, "", &all);
	bool twice = added && !density->nterms;
	density->outside = d->outside > density->outside ? d->outside : density->outside;
	for (size_t i = 0; i < d->sets->n && !status && (added || d->sets->n < all.n); i++) {
		twice |= is_term(density, d->sets->name[i]) || density->nterms == PM_TERMS;
		if (!twice)
			snprintf(density->terms[density->nterms++], PM_NAME, "%s", d->sets->name[i]);
	}
	if ((size_t)density->nterms == all.n)
		density->nterms = 0;
	if (twice)
		density->outside = PM_OUTSIDE_ERROR;
	return status;
}

int pm_makes_density(struct pm_frame *f, const struct pm_mesh *m, const struct pm_density *d, bool add)
{
	const struct pm_field *q = pm_frame_field(f, d->sets->name[0], d->strength), *old = pm_frame_field(f, m->name, d->name);
	int status = check_density(f, old, d, add);
	if (status)
		return status;
	struct pm_field *density = old && add ? pm_changes(f, m->name, d->name) : pm_makes(f, m->name, d->name, q->components, PM_DERIVED);
	if (!density)
		return -PM_DATA;
	snprintf(density->kernel, sizeof density->kernel, "%s", d->kernel->name);
	density->interlaced = d->interlaced;
	density->rim = d->rim;
	if (q->extensive)
		unit_over_volume(q->unit, f->dim, density->unit, sizeof density->unit);
	return mark_sources(f, d, old && add, density);
}

struct pm_field *pm_makes_gathered(struct pm_frame *f, const char *set, const struct pm_field *from)
{
	const struct pm_field *old = pm_frame_field(f, set, from->name);
	bool strength = old && old->extensive;
	enum pm_role role = old ? old->role : PM_DERIVED;
	if (strength && !pm_frame_field(f, set, "volume")) {
		pm_fail(PM_DATA, "'%s' on '%s' is a strength: the mesh value must be multiplied by a 'volume', and there is none (scalc makes one)",
			old->name, set);
		return NULL;
	}
	if (old && !strength && role != PM_DERIVED) {
		pm_fail(PM_DATA, "'%s' on '%s' is %s, which mesh values do not replace", old->name, set, pm_role_names[role]);
		return NULL;
	}
	if (strength && !pm_reads(f, set, "volume"))
		return NULL;
	struct pm_field *made = pm_makes(f, set, from->name, from->components, role);
	if (made) {
		made->extensive = strength;
		snprintf(made->unit, sizeof made->unit, "%s", strength ? "" : from->unit);
	}
	return made;
}
