/* The residual of Poisson's equation on the nodes of a mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#include "mesh/poisson-residual.h"

#include "mesh/laplacian.h"

static bool unknown(const struct pm_laplacian *l, size_t row, size_t i)
{
	const struct pm_laplacian_axis *x = &l->axis[0];
	return i >= x->first && i < x->end && pm_laplacian_inside(l, row % l->axis[1].points, row / l->axis[1].points);
}

int pm_poisson_residual(const struct pm_grid *g, double c, const double *s, const double *phi, double *r, double *size, double *source)
{
	const struct pm_laplacian l = pm_laplacian_of(g);
	double *f = pm_alloc(l.size, sizeof *f), *u = pm_alloc(l.size, sizeof *u), *sums = pm_alloc(l.rows, sizeof *sums);
	const bool good = f && u && sums;
	const double mean = good && l.singular ? pm_laplacian_mean(&l, s, sums) : 0;
	for (size_t p = 0; good && p < l.size; p++) {
		const bool in = unknown(&l, p / l.axis[0].points, p % l.axis[0].points);
		f[p] = in ? c * (s[p] - mean) : 0;
		u[p] = in && phi ? phi[p] : 0;
	}
	if (good) {
		*size = sqrt(pm_laplacian_residual(&l, u, f, r, sums) / (double)l.size);
		*source = sqrt(pm_laplacian_product(&l, f, f, sums) / (double)l.size);
	}
	for (size_t p = 0; good && p < l.size; p++)
		r[p] = -r[p];
	pm_free(f), pm_free(u), pm_free(sums);
	return good ? 0 : -PM_DATA;
}
