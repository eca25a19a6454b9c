/* A gradient by differences that is left to be made. Every node of a periodic box has the same pairs of nodes; elsewhere, and by transforms, it is made at
 * once.
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
	for (int c = 0; c < 3; c++)
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
	bool periodic = pm_world_alone() && o->grid.dim == 3 && o->kind == PM_OP_GRAD && o->order && o->in == 1 && !t->source->interlaced;
	for (int d = 0; d < 3 && periodic; d++)
		periodic = o->grid.face[d][0] == PM_PERIODIC && o->grid.points[d] > (size_t)o->order;
	return periodic && t->source->type == PM_F64 && t->target->type == PM_F64;
}

/* A row of the potential, and those beside it: the largest square of the nodes from..to-1, all of whose pairs are on the row. */
static inline __attribute__((always_inline)) double largest_of_row(int pairs, const struct pm_gradient_later *l, const double *const up[3][3],
	const double *const down[3][3], size_t from, size_t to)
{
	double most = 0;
#ifndef __clang__ /* makes no vectors of a maximum that a NaN may stand beside, and warns */
#pragma omp simd reduction(max : most)
#endif
	for (size_t i = from; i < to; i++) {
		double square = 0;
		for (int d = 0; d < 3; d++) {
			double sum = 0;
			for (int k = 0; k < pairs; k++)
				sum += l->weight[d][k] * (up[d][k][i] - down[d][k][i]);
			square += sum * sum;
		}
		most = square > most ? square : most;
	}
	return most;
}

/* Nodes at the ends of a row, whose pairs go over the end of the box. */
static double largest_of_ends(int pairs, const struct pm_gradient_later *l, const double *const up[3][3], const double *const down[3][3], const double *here)
{
	const size_t n = l->operator.grid.points[0], reach = (size_t)pairs;
	double most = 0;
	for (size_t e = 0; e < 2 * reach; e++) {
		const size_t i = e < reach ? e : n - 1 - (e - reach);
		double square = 0;
		for (int d = 0; d < 3; d++) {
			double sum = 0;
			for (size_t k = 0; k < reach; k++)
				sum += l->weight[d][k] * (d ? up[d][k][i] - down[d][k][i] : here[(i + k + 1) % n] - here[(i + n - k - 1) % n]);
			square += sum * sum;
		}
		most = fmax(most, square);
	}
	return most;
}

double pm_gradient_later_most(const struct pm_gradient_later *l)
{
	const size_t *n = l->operator.grid.points;
	const int pairs = l->operator.order / 2;
	const double *phi = pm_in(l->later.from, 0);
	double most = 0;
#pragma omp parallel for schedule(static) reduction(max : most) if (n[0] * n[1] * n[2] > pm_many_turns())
	for (size_t row = 0; row < n[1] * n[2]; row++) {
		const size_t y = row % n[1], z = row / n[1];
		const double *const here = phi + row * n[0], *up[3][3], *down[3][3];
		for (size_t k = 0; k < 3; k++) {
			const size_t far = (int)k < pairs ? k + 1 : 1;
			up[0][k] = here + far, down[0][k] = here - far;
			up[1][k] = phi + (z * n[1] + (y + far) % n[1]) * n[0], down[1][k] = phi + (z * n[1] + (y + n[1] - far) % n[1]) * n[0];
			up[2][k] = phi + ((z + far) % n[2] * n[1] + y) * n[0], down[2][k] = phi + ((z + n[2] - far) % n[2] * n[1] + y) * n[0];
		}
		const size_t from = (size_t)pairs, to = n[0] - from;
		const double inside = pairs == 1 ? largest_of_row(1, l, up, down, from, to) :
			pairs == 2 ? largest_of_row(2, l, up, down, from, to) : largest_of_row(3, l, up, down, from, to);
		most = fmax(most, fmax(inside, largest_of_ends(pairs, l, up, down, here)));
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
	for (int d = 0; d < 3; d++) {
		double sum = 0;
		pm_operator_pairs(&t->operator, d, t->factor, l->weight[d]);
		for (int k = 0; k < t->operator.order / 2; k++)
			weights = fmax(weights, fabs(l->weight[d][k])), sum += 2 * fabs(l->weight[d][k]);
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
