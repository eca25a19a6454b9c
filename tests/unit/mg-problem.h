/* What the tests of multigrid share: grids, noise, and the factor of a cycle. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TEST_MG_PROBLEM_H
#define PM_TEST_MG_PROBLEM_H

#include "check.h"
#include "poisson-mg/mg.h"

/* faces: two letters per axis, p w n; box of lengths l */
__attribute__((unused)) static struct pm_grid grid(int dim, const size_t *cells, const double *l, const char *faces)
{
	struct pm_grid g = {.dim = dim};
	for (int d = 0; d < 3; d++) {
		g.cells[d] = d < dim ? cells[d] : 1;
		g.h[d] = d < dim ? l[d] / (double)cells[d] : 1;
		for (int s = 0; s < 2; s++) {
			char c = d < dim ? faces[2 * d + s] : 'p';
			g.face[d][s] = c == 'p' ? PM_PERIODIC : c == 'w' ? PM_WALL : PM_NEUMANN;
		}
		g.points[d] = d < dim ? g.cells[d] + (g.face[d][0] != PM_PERIODIC) : 1;
	}
	return g;
}

__attribute__((unused)) static struct pm_grid cube(int dim, size_t n, const char *faces)
{
	return grid(dim, (size_t[]){n, n, n}, (double[]){1, 1, 1}, faces);
}

__attribute__((unused)) static double *values(size_t n) { return pm_zalloc(n, sizeof(double)); }

__attribute__((unused)) static double largest(size_t n, const double *a, const double *b)
{
	double most = 0;
	for (size_t i = 0; i < n; i++)
		check_worst(&most, fabs(a[i] - (b ? b[i] : 0)));
	return most;
}

__attribute__((unused)) static void noise(size_t n, double *a)
{
	for (size_t i = 0; i < n; i++) {
		double u[2];
		pm_random(7, i, 0, u);
		a[i] = u[0] - 0.5;
	}
}

/* The factor by which a cycle reduces the residual after many: lap u = 0 from noise, no round-off. 60 cycles, as the reference took: V(1,0) converges slowly
 * to its asymptotic factor. */
__attribute__((unused)) static double factor_of(struct pm_grid g, int order, struct pm_mg_choice o)
{
	size_t n = pm_grid_size(&g);
	double *f = values(n), *u = values(n), first = 1, last = 1;
	struct pm_mg *mg = pm_mg_new(&g, order);
	noise(n, u);
	pm_mg_start(mg, f, u);
	for (int i = 0; i < 60; i++) {
		pm_mg_once(mg, &o);
		first = i == 39 ? pm_mg_residual(mg) : first;
	}
	last = pm_mg_residual(mg);
	pm_mg_free(mg), pm_free(f), pm_free(u);
	return first == 0 ? 0 : pow(last / first, 0.05); /* 0: 1e-300 is reached within 40 cycles */
}

#endif
