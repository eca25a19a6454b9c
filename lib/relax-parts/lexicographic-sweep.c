/* Nodes in the order of memory, forward or back, in 3-D by diagonals of rows. Cost: N per sweep.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "relax-parts/lexicographic-sweep.h"
#include "relax-parts/young-theory.h"

/* Inlined twice, so that the direction is known in the loop. */
static inline double sweep_row(const struct pm_laplacian *l, double factor, struct pm_laplacian_row a, bool forward)
{
	const struct pm_laplacian_axis *x = &l->axis[0];
	double sum = 0;
	for (size_t n = x->end - x->first, q = 0; q < n; q++) {
		size_t i = forward ? x->first + q : x->end - 1 - q;
		double r = pm_laplacian_node(l, &a, i) - a.f[i];
		a.u[i] += factor * r;
		sum += pm_laplacian_weight(x, i) * r * r;
	}
	return a.weight * sum;
}

void pm_lexicographic_sweep(const struct pm_laplacian *l, double relaxation, double *u, const double *f, double *sums, bool forward)
{
	const struct pm_laplacian_axis *y = &l->axis[1], *z = &l->axis[2];
	const double factor = relaxation / l->diagonal;
	size_t diagonals = y->points + z->points - 1;
	#pragma omp parallel if (l->size > pm_laplacian_parallel && z->points > 1)
	for (size_t q = 0; q < diagonals; q++) {
		size_t sum = forward ? q : diagonals - 1 - q, low = sum < z->points ? 0 : sum - z->points + 1, high = sum < y->points ? sum : y->points - 1;
		#pragma omp for schedule(static)
		for (size_t j = low; j <= high; j++) {
			size_t k = sum - j;
			sums[j + y->points * k] = 0;
			if (!pm_laplacian_inside(l, j, k))
				continue;
			const struct pm_laplacian_row row = pm_laplacian_row_at(l, u, f, j, k);
			sums[j + y->points * k] = forward ? sweep_row(l, factor, row, true) : sweep_row(l, factor, row, false);
		}
	}
}

double pm_lexicographic_relax(struct pm_relax_work *w)
{
	pm_lexicographic_sweep(w->lap, w->factor, w->u, w->f, w->sums, true);
	w->fresh = false;
	return pm_laplacian_total(w->lap, w->sums);
}

double pm_lexicographic_radius(const struct pm_laplacian *l, double factor)
{
	for (int d = 0; d < 3; d++)
		if (l->axis[d].periodic && l->axis[d].points > 1)
			return NAN;
	return pm_young_radius(l, factor);
}
