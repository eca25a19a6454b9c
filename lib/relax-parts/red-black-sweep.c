/* Red nodes, then black ones; any number of threads, the same bytes. Cost: N per sweep.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "relax-parts/red-black-sweep.h"
#include "relax-parts/young-theory.h"

static double sweep_row(const struct pm_laplacian *l, double factor, size_t odd, struct pm_laplacian_row a)
{
	const struct pm_laplacian_axis *x = &l->axis[0];
	double sum = 0;
	for (size_t i = x->first + ((x->first + odd) & 1); i < x->end; i += 2) {
		double r = pm_laplacian_node(l, &a, i) - a.f[i];
		a.u[i] += factor * r;
		sum += pm_laplacian_weight(x, i) * r * r;
	}
	return a.weight * sum;
}

static bool at_seam(const struct pm_laplacian_axis *a, size_t i)
{
	return a->periodic && a->points > 1 && a->points % 2 == 1 && i + 1 == a->points;
}

double pm_red_black_sweep(struct pm_relax_work *w)
{
	const struct pm_laplacian *l = w->lap;
	const struct pm_laplacian_axis *y = &l->axis[1], *z = &l->axis[2];
	const double factor = w->factor / l->diagonal;
	const bool seam = at_seam(y, y->points - 1) || at_seam(z, z->points - 1);
	for (size_t colour = 0; colour < 2; colour++)
		for (int late = 0; late <= 2 * seam; late++) { /* rows at the seam of y, then the plane at that of z: what is beside them has changed */
			pm_laplacian_beside(l, w->u);
			#pragma omp parallel for schedule(static) if (!late && l->size > pm_laplacian_parallel)
			for (size_t q = 0; q < l->rows; q++) {
				size_t j = (l->first + q) % y->points, k = (l->first + q) / y->points;
				if (!colour && !late)
					w->sums[q] = 0;
				if (pm_laplacian_inside(l, j, k) && (at_seam(z, k) ? 2 : at_seam(y, j) ? 1 : 0) == late)
					w->sums[q] += sweep_row(l, factor, j + k + colour, pm_laplacian_row_at(l, w->u, w->f, j, k));
			}
		}
	w->fresh = false;
	return pm_laplacian_total(l, w->sums);
}

double pm_red_black_radius(const struct pm_laplacian *l, double factor)
{
	for (int d = 0; d < 3; d++)
		if (l->axis[d].periodic && l->axis[d].points > 1 && l->axis[d].points % 2 == 1)
			return NAN;
	return pm_young_radius(l, factor);
}
