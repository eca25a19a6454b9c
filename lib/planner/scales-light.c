/* Scales of fields that evolve by Maxwell's equations: the longest step of light on the mesh, the part of the energy that is magnetic, and the wave number of
 * B, which charges at rest do not make. Sums by the law of sums. Source: the definitions; Yee 1966 for the limit of the step.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "maxwell/maxwell.h"
#include "mesh/gradient.h"
#include "planner/scales.h"
#include "stream/field-value.h"
#include "stream/over-stretches.h"

static void make_squares(const void *data, size_t from, size_t to, void *part)
{
	const struct pm_field *y = data;
	for (size_t i = from; i < to; i++)
		for (int c = 0; c < y->components; c++)
			pm_sum_add(part, pm_value_at(y, c, i) * pm_value_at(y, c, i));
}

/* [value^2 times points] of a field of the mesh */
static double square(const struct pm_frame *f, const struct pm_mesh *m, const char *name)
{
	const struct pm_parts parts = {.size = sizeof(struct pm_sum), .make = make_squares, .join = pm_join_sums};
	const struct pm_field *y = pm_frame_field(f, m->name, name);
	struct pm_sum sum = {0, 0};
	if (y)
		pm_over_set(&parts, y, y->count, &sum);
	return pm_sum_total(sum);
}

struct moving {
	const struct pm_field *v, *m;
};

static void make_kinetic(const void *data, size_t from, size_t to, void *part)
{
	const struct moving *p = data;
	for (size_t i = from; i < to; i++)
		for (int c = 0; c < p->v->components; c++)
			pm_sum_add(part, pm_value_at(p->m, 0, i) * pow(pm_value_at(p->v, c, i), 2));
}

/* sum m v^2 */
static double twice_kinetic(const struct pm_frame *f)
{
	const struct pm_parts parts = {.size = sizeof(struct pm_sum), .make = make_kinetic, .join = pm_join_sums};
	struct pm_sum sum = {0, 0};
	for (size_t k = 0; k < f->nsets; k++) {
		const struct moving p = {pm_frame_field(f, f->sets[k]->name, "v"), pm_frame_field(f, f->sets[k]->name, "mass")};
		if (p.v && p.m)
			pm_over_set(&parts, &p, p.v->count, &sum);
	}
	return pm_sum_total(sum);
}

static int wave_number(const struct pm_frame *f, const struct pm_mesh *m, const struct pm_field *B, double *k)
{
	const struct pm_grid g = pm_grid_of(f, m);
	const size_t n = pm_grid_size(&g);
	struct pm_operator lap;
	double *made = pm_alloc(n, sizeof *made), *out[1] = {made};
	struct pm_sum curved = {0, 0}, all = {0, 0};
	int status = made ? pm_operator_init(&lap, &g, PM_OP_LAP, 2, 1, false) : -PM_DATA;
	for (int c = 0; c < B->components && !status && B->buffer; c++) {
		const double *const y[1] = {pm_in(B, c)};
		status = pm_operator_apply(&lap, 1, y, out, NULL);
		pm_sum_of_set(status ? 0 : n, made, made, &curved);
		pm_sum_of_set(status ? 0 : n, y[0], y[0], &all);
	}
	*k = !status && pm_sum_total(all) > 0 ? pow(pm_sum_total(curved) / pm_sum_total(all), 0.25) : NAN;
	pm_free(made);
	return status;
}

int pm_scales_light(const struct pm_frame *f, const struct pm_law *law, struct pm_scales *s)
{
	const double eps0 = pm_frame_constant(f, "eps0", 1);
	double E2 = 0, B2 = 0;
	int status = 0;
	for (size_t i = 0; i < f->nmeshes && !status; i++) {
		const struct pm_mesh *m = f->meshes[i];
		const struct pm_field *B = pm_frame_field(f, m->name, law->magnetic);
		double cell = 1;
		if (!B || !pm_frame_field(f, m->name, law->field))
			continue;
		for (int d = 0; d < f->dim; d++)
			cell *= m->h[d];
		E2 += cell * square(f, m, law->field), B2 += cell * s->c * s->c * square(f, m, law->magnetic);
		if (!(s->courant > 0)) {
			const struct pm_grid g = pm_grid_of(f, m);
			s->courant = pm_maxwell_find("yee")->limit(&g) / s->c;
		}
		status = isnan(s->wiggle) ? wave_number(f, m, B, &s->wiggle) : 0;
	}
	const double all = E2 + B2 + twice_kinetic(f) / eps0;
	s->magnetic = all > 0 ? B2 / all : 0;
	return status;
}
