/* One axis and pass after the other, from one array to the other and back. Cost: 16 bytes a point, axis and pass. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/index-fold.h"
#include "mesh/smooth.h"

/* out = centre in + side (the neighbours along axis d), in the planes here; in has a plane more on either side if these are not all. */
static void pass(const struct pm_grid *g, const struct pm_planes *p, int d, double centre, double side, const double *in, double *out)
{
	const bool periodic = g->face[d][0] == PM_PERIODIC, ahead = p->divided && d == p->axis && periodic;
	const size_t nx = g->points[0], n = g->points[d], rows = p->here * p->size / nx, stride = d == 2 ? nx * g->points[1] : nx;
	const size_t first = pm_planes_row(p, 0);
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
		const size_t row = first + r, at = d == 1 ? row % g->points[1] : row / g->points[1];
		const ptrdiff_t down = ahead ? -1 : (ptrdiff_t)pm_index_below(at, n, periodic) - (ptrdiff_t)at;
		const ptrdiff_t up = ahead ? 1 : (ptrdiff_t)pm_index_above(at, n, periodic) - (ptrdiff_t)at;
		const double *below = a + down * (ptrdiff_t)stride, *above = a + up * (ptrdiff_t)stride;
		for (size_t i = 0; i < nx; i++)
			b[i] = centre * a[i] + side * (below[i] + above[i]);
	}
}

int pm_smooth(int status, const struct pm_grid *g, const struct pm_planes *p, int n, bool compensated, double *values, double *work)
{
	double *in = values, *out = work;
	for (int d = 0; d < g->dim; d++)
		for (int k = 0; k < n + compensated; k++) {
			const double centre = k < n ? 0.5 : 1 + 0.5 * n, side = k < n ? 0.25 : -0.25 * n;
			const double *with[1] = {in};
			double *room = NULL;
			if (p->divided && d && d == p->axis)
				status = pm_planes_halo(status, p, 1, 1, (const double *const[]){in}, with, &room);
			if (!status)
				pass(g, p, d, centre, side, with[0], out);
			pm_free(room);
			double *was = in;
			in = out, out = was;
		}
	if (in != values && !status)
		memcpy(values, in, p->here * p->size * sizeof *values);
	return status;
}
