/* A gradient, or a curl in the plane, by differences that is left to be made. Every node of a periodic box has the same pairs of nodes; elsewhere, and by
 * transforms, it is made at once.
 * Cost: a pass over the potential, for its largest value where that is not known. SPDX-License-Identifier: GPL-3.0-or-later */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/largest.h"
#include "mesh/gradient-later.h"
#include "mesh/gradient-parts.h"
#include "world/world.h"

static int make(const struct pm_later *later, double *to)
{
	const struct pm_gradient_later *l = (const struct pm_gradient_later *)later;
	const size_t points = pm_grid_size(&l->operator.grid);
	const double *in[] = {pm_in(later->from, 0)};
	double *out[3];
	for (int c = 0; c < l->operator.out; c++)
		out[c] = to + (size_t)c * points;
	return pm_operator_apply(&l->operator, l->factor, in, out, NULL);
}

const struct pm_gradient_later *pm_gradient_later_of(const struct pm_field *field)
{
	const struct pm_later *later = pm_field_later_of(field);
	return later && later->make == make ? (const struct pm_gradient_later *)later : NULL;
}

static bool can(const struct pm_gradient *t)
{
	const struct pm_operator *o = &t->operator;
	const int dim = o->grid.dim;
	/* a gradient, or a curl in the plane: one term for each component, in their order */
	bool periodic = pm_world_alone() && dim > 1 && o->in == 1 && o->out == dim && o->nterms == dim && o->order && !t->source->interlaced;
	for (int d = 0; d < dim && periodic; d++)
		periodic = o->grid.face[d][0] == PM_PERIODIC && o->grid.points[d] > (size_t)o->order;
	return periodic && t->source->type == PM_F64 && t->target->type == PM_F64;
}

/* A row of the potential, and those beside it. */
struct rows {
	const double *here, *up[3][3], *down[3][3]; /* [component][pair] */
};

/* The largest square of the nodes from..to-1, all of whose pairs are on the row. */
static inline __attribute__((always_inline)) double largest_of_row(int dim, int pairs, const struct pm_gradient_later *l, const struct rows *r, size_t from,
	size_t to)
{
	double most = 0;
#ifndef __clang__ /* makes no vectors of a maximum that a NaN may stand beside, and warns */
#pragma omp simd reduction(max : most)
#endif
	for (size_t i = from; i < to; i++) {
		double square = 0;
		for (int c = 0; c < dim; c++) {
			double sum = 0;
			for (int k = 0; k < pairs; k++)
				sum += l->weight[c][k] * (r->up[c][k][i] - r->down[c][k][i]);
			square += sum * sum;
		}
		most = square > most ? square : most;
	}
	return most;
}

static double largest_inside(const struct pm_gradient_later *l, const struct rows *r, size_t from, size_t to)
{
	const bool plane = l->operator.grid.dim == 2;
	switch (l->operator.order) {
	case 2: return plane ? largest_of_row(2, 1, l, r, from, to) : largest_of_row(3, 1, l, r, from, to);
	case 4: return plane ? largest_of_row(2, 2, l, r, from, to) : largest_of_row(3, 2, l, r, from, to);
	default: return plane ? largest_of_row(2, 3, l, r, from, to) : largest_of_row(3, 3, l, r, from, to);
	}
}

/* Nodes at the ends of a row, whose pairs go over the end of the box. */
static double largest_of_ends(const struct pm_gradient_later *l, const struct rows *r)
{
	const size_t n = l->operator.grid.points[0], reach = (size_t)l->operator.order / 2;
	double most = 0;
	for (size_t e = 0; e < 2 * reach; e++) {
		const size_t i = e < reach ? e : n - 1 - (e - reach);
		double square = 0;
		for (int c = 0; c < l->operator.grid.dim; c++) {
			double sum = 0;
			for (size_t k = 0; k < reach; k++) {
				const double *up = l->axis[c] ? &r->up[c][k][i] : &r->here[(i + k + 1) % n];
				const double *down = l->axis[c] ? &r->down[c][k][i] : &r->here[(i + n - k - 1) % n];
				sum += l->weight[c][k] * (*up - *down);
			}
			square += sum * sum;
		}
		most = fmax(most, square);
	}
	return most;
}

static struct rows rows_of(const struct pm_gradient_later *l, const double *phi, size_t row)
{
	const size_t *n = l->operator.grid.points, y = row % n[1], z = row / n[1], pairs = (size_t)l->operator.order / 2;
	struct rows r = {.here = phi + row * n[0]};
	for (int c = 0; c < l->operator.grid.dim; c++)
		for (size_t k = 0; k < pairs; k++) {
			const size_t far = k + 1;
			const size_t up[3] = {row, z * n[1] + (y + far) % n[1], (z + far) % n[2] * n[1] + y};
			const size_t down[3] = {row, z * n[1] + (y + n[1] - far) % n[1], (z + n[2] - far % n[2]) % n[2] * n[1] + y};
			r.up[c][k] = l->axis[c] ? phi + up[l->axis[c]] * n[0] : r.here + far;
			r.down[c][k] = l->axis[c] ? phi + down[l->axis[c]] * n[0] : r.here - far;
		}
	return r;
}

double pm_gradient_later_most(const struct pm_gradient_later *l)
{
	const size_t *n = l->operator.grid.points, reach = (size_t)l->operator.order / 2;
	const double *phi = pm_in(l->later.from, 0);
	double most = 0;
#pragma omp parallel for schedule(static) reduction(max : most) if (n[0] * n[1] * n[2] > pm_many_turns())
	for (size_t row = 0; row < n[1] * n[2]; row++) {
		const struct rows r = rows_of(l, phi, row);
		most = fmax(most, fmax(largest_inside(l, &r, reach, n[0] - reach), largest_of_ends(l, &r)));
	}
	return sqrt(most) * (1 + 1e-9);
}

int pm_gradient_leave(struct pm_gradient *t, bool *left)
{
	*left = false;
	if (!can(t))
		return 0;
	struct pm_gradient_later *l = calloc(1, sizeof *l);
	if (!l)
		return pm_no_memory();
	l->later.make = make, l->operator = t->operator, l->factor = t->factor;
	double weights = 0, square = 0;
	for (int c = 0; c < t->operator.out; c++) {
		double sum = 0;
		l->axis[c] = t->operator.term[c].axis;
		pm_operator_pairs(&t->operator, c, t->factor, l->weight[c]);
		for (int k = 0; k < t->operator.order / 2; k++)
			weights = fmax(weights, fabs(l->weight[c][k])), sum += 2 * fabs(l->weight[c][k]);
		square += sum * sum;
	}
	const double most = t->source->within > 0 ? t->source->within : pm_largest(pm_grid_size(&t->operator.grid), pm_in(t->source, 0));
	if (!(fmax(weights, 1) * most < DBL_MAX / 8)) { /* differences of two, sums of three */
		free(l);
		return 0;
	}
	l->within = sqrt(square) * most * (1 + 1e-9);
	*left = true;
	return pm_field_later(t->target, &l->later, t->source);
}
