/* One axis and pass after the other, from one array to the other and back. Cost: 16 bytes a point, axis and pass. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/index-fold.h"
#include "mesh/smooth.h"

/* out = centre in + side (the neighbours along axis d). */
static void pass(const struct pm_grid *g, int d, double centre, double side, const double *in, double *out)
{
	const bool periodic = g->face[d][0] == PM_PERIODIC;
	const size_t nx = g->points[0], n = g->points[d], rows = g->points[1] * g->points[2], stride = d == 2 ? nx * g->points[1] : nx;
#pragma omp parallel for schedule(static) num_threads(pm_threads()) if (rows * nx > 16384)
	for (size_t r = 0; r < rows; r++) {
		const double *a = in + r * nx;
		double *b = out + r * nx;
		if (d == 0) {
			for (size_t i = 1; i + 1 < nx; i++)
				b[i] = centre * a[i] + side * (a[i - 1] + a[i + 1]);
			for (size_t i = 0; i < nx; i += nx > 1 ? nx - 1 : 1)
				b[i] = centre * a[i] + side * (a[pm_index_below(i, n, periodic)] + a[pm_index_above(i, n, periodic)]);
			continue;
		}
		const size_t at = d == 1 ? r % g->points[1] : r / g->points[1];
		const double *plane = in + (r * nx - stride * at), *below = plane + stride * pm_index_below(at, n, periodic);
		const double *above = plane + stride * pm_index_above(at, n, periodic);
		for (size_t i = 0; i < nx; i++)
			b[i] = centre * a[i] + side * (below[i] + above[i]);
	}
}

void pm_smooth(const struct pm_grid *g, int n, bool compensated, double *values, double *work)
{
	double *in = values, *out = work;
	for (int d = 0; d < g->dim; d++)
		for (int k = 0; k < n + compensated; k++) {
			const double centre = k < n ? 0.5 : 1 + 0.5 * n, side = k < n ? 0.25 : -0.25 * n;
			pass(g, d, centre, side, in, out);
			double *was = in;
			in = out, out = was;
		}
	if (in != values)
		memcpy(values, in, pm_grid_size(g) * sizeof *values);
}
