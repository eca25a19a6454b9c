/* A gradient by differences that is left to be made. Every node of a periodic box has the same pairs of nodes; elsewhere, and by transforms, it is made at
 * once.
 * Cost: a pass over the potential, for its largest value. SPDX-License-Identifier: GPL-3.0-or-later */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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

/* The largest of absolute values that are finite: numbers without a sign are in the order of their bits. */
static double largest(size_t n, const double *x)
{
	int64_t most = 0;
	double value;
#pragma omp parallel for schedule(static) reduction(max : most) if (n > 65536)
	for (size_t i = 0; i < n; i++) {
		int64_t bits;
		memcpy(&bits, x + i, sizeof bits);
		bits &= INT64_MAX;
		most = bits > most ? bits : most;
	}
	memcpy(&value, &most, sizeof value);
	return value;
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
	double weights = 0;
	for (int d = 0; d < 3; d++) {
		pm_operator_pairs(&t->operator, d, t->factor, l->weight[d]);
		for (int k = 0; k < t->operator.order / 2; k++)
			weights = fmax(weights, fabs(l->weight[d][k]));
	}
	const double most = largest(pm_grid_size(&t->operator.grid), pm_in(t->source, 0));
	if (!(fmax(weights, 1) * most < DBL_MAX / 8)) { /* differences of two, sums of three */
		free(l);
		return 0;
	}
	*left = true;
	return pm_field_later(t->target, &l->later, t->source);
}
