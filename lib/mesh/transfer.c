/* placeholder until the tiles */
#include "mesh/transfer_axis.h"

int pm_spread(const struct pm_transfer *t, size_t n, const double *const x[], const double *const strength[], double *const mesh[],
	struct pm_strays *strays)
{
	return pm_spread_plain(t, n, x, strength, mesh, strays);
}

int pm_gather(const struct pm_transfer *t, size_t n, const double *const x[], const double *const mesh[], const double *factor,
	double *const out[], struct pm_strays *strays)
{
	return pm_gather_plain(t, n, x, mesh, factor, out, strays);
}

/* Cells missing below and above on one axis. floor + 1: one cell to spare against rounding. */
static int grow_axis(const struct pm_grid *g, int d, double r, size_t n, const double *x, double *below, double *above)
{
	double least = INFINITY, most = -INFINITY, cells = (double)g->cells[d];
	for (size_t p = 0; p < n; p++) {
		double s = (x[p] - g->lo[d]) / g->h[d];
		least = fmin(least, s);
		most = fmax(most, s);
	}
	*below = g->face[d][0] != PM_PERIODIC && least < r ? floor(r - least) + 1 : 0;
	*above = g->face[d][0] != PM_PERIODIC && most > cells - r ? floor(most - (cells - r)) + 1 : 0;
	for (int side = 0; side < 2; side++) {
		bool closed = g->face[d][side] == PM_WALL || g->face[d][side] == PM_NEUMANN;
		if (closed && (side ? most > cells : least < 0))
			return pm_fail(PM_DATA, "particles are beyond the %s face of axis %c, and only open faces can be moved (push them back, or --outside drop)",
				pm_face_names[g->face[d][side]], "xyz"[d]);
		if (closed)
			*(side ? above : below) = 0;
	}
	return 0;
}

int pm_transfer_grow(const struct pm_transfer *t, size_t n, const double *const x[], size_t below[3], size_t above[3])
{
	double points = 1;
	for (int d = 0; d < t->grid.dim; d++) {
		double low = 0, high = 0;
		int status = n ? grow_axis(&t->grid, d, 0.5 * t->kernel->width, n, x[d], &low, &high) : 0;
		if (status)
			return status;
		points *= (double)t->grid.cells[d] + low + high + 1;
		if (points > PM_TRANSFER_POINTS)
			return pm_fail(PM_DATA, "the mesh would grow to more than %g points to hold every particle (--outside drop leaves far ones out)",
				(double)PM_TRANSFER_POINTS);
		below[d] = (size_t)low;
		above[d] = (size_t)high;
	}
	return 0;
}
