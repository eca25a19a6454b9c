/* Jacobi's sweep; rows are independent, any number of threads. Cost: N per sweep.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "relax-parts/jacobi-sweep.h"

double pm_jacobi_sweep(struct pm_relax_work *w)
{
	const struct pm_laplacian *l = w->lap;
	size_t nx = l->axis[0].points, ny = l->axis[1].points;
	const double factor = w->factor / l->diagonal;
	double *next = w->extra[0];
	pm_laplacian_beside(l, w->u);
	#pragma omp parallel for schedule(static) if (l->size > pm_laplacian_parallel)
	for (size_t q = 0; q < l->rows; q++) {
		double *out = next + q * nx;
		const size_t j = (l->first + q) % ny, k = (l->first + q) / ny;
		w->sums[q] = 0;
		if (!pm_laplacian_inside(l, j, k)) {
			memcpy(out, w->u + q * nx, nx * sizeof *out); /* a wall */
			continue;
		}
		struct pm_laplacian_row a = pm_laplacian_row_at(l, w->u, w->f, j, k);
		w->sums[q] = pm_laplacian_row_residual(l, &a, out);
		for (size_t i = 0; i < nx; i++)
			out[i] = a.u[i] + factor * out[i];
	}
	w->extra[0] = w->u;
	w->u = next;
	w->fresh = false;
	return pm_laplacian_total(l, w->sums);
}

double pm_jacobi_radius(const struct pm_laplacian *l, double factor)
{
	return fmax(fabs(1 - factor * (1 - l->highest)), fabs(1 - factor * (1 - l->lowest)));
}
