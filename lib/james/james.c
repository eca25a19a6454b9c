/* Free space by James' method for the solvers of the differences of order 2 (multigrid has its own: mg-open.c): the box is solved grounded, the charge on
 * its walls gives the potential there, and it is solved again with that:
 *   A u = f, u = 0 on the walls; q = A u - f on them; phi = -G*q on them; A phi = f inside
 * G is that of the infinite lattice, so the answer is the solution of the differences on all of it: the error is of order 2, whatever the size of the box.
 * Source: James 1977. The source vanishes outside. Cost: two solutions, and 100 N^3 operations for the walls. SPDX-License-Identifier: GPL-3.0-or-later */
#include "james/james.h"

#include <string.h>

#include "poisson-mg/mg-open-parts.h"

struct pm_james {
	struct pm_grid grid, walled;
	struct mg_stencil stencil;
	struct mg_faces *faces;
	double *charge, *wall, *f; /* of the points of the grid */
};

bool pm_james_wanted(const struct pm_grid *g)
{
	bool open = false;
	for (int d = 0; d < g->dim; d++)
		open = open || g->face[d][0] == PM_OPEN || g->face[d][1] == PM_OPEN;
	return open;
}

int pm_james_check(const struct pm_grid *g)
{
	for (int d = 0; d < g->dim; d++)
		if (g->face[d][0] != PM_OPEN || g->face[d][1] != PM_OPEN)
			return pm_fail(PM_DATA, "James' method needs open faces on all axes or on none, but axis %c has %s ones (poisson-fft "
				"--free-space doubled mixes them)", "xyz"[d], pm_face_names[g->face[d][g->face[d][0] == PM_OPEN]]);
	return pm_mg_open_check(g);
}

struct pm_grid pm_james_walled(const struct pm_grid *g)
{
	struct pm_grid walled = *g;
	for (int d = 0; d < g->dim; d++)
		walled.face[d][0] = walled.face[d][1] = PM_WALL;
	return walled;
}

struct pm_james *pm_james_new(const struct pm_grid *g)
{
	struct pm_james *o = pm_zalloc(1, sizeof *o);
	if (!o)
		return NULL;
	size_t n = pm_grid_size(g);
	o->grid = *g;
	o->walled = pm_james_walled(g);
	o->stencil = pm_mg_stencil(g, 2);
	o->charge = pm_zalloc(n, sizeof(double));
	o->wall = pm_zalloc(n, sizeof(double));
	o->f = pm_zalloc(n, sizeof(double));
	if (!o->charge || !o->wall || !o->f || pm_mg_lattice(g, 2, o->f) || !(o->faces = pm_mg_faces_new(g, o->f)))
		return pm_james_free(o);
	return o;
}

struct pm_james *pm_james_free(struct pm_james *o)
{
	if (o)
		pm_mg_faces_free(o->faces), pm_free(o->charge), pm_free(o->wall), pm_free(o->f);
	return pm_free(o);
}

/* A u - f on the walls, where u is zero: only the neighbours inside count. 0 elsewhere. */
static void induced(struct pm_james *o, const double *u)
{
	const struct pm_grid *g = &o->grid;
	const size_t step[3] = {1, g->points[0], g->points[0] * g->points[1]};
	#pragma omp parallel for if (pm_grid_size(g) > 16384)
	for (size_t row = 0; row < g->points[1] * g->points[2]; row++)
		for (size_t i = 0; i < g->points[0]; i++) {
			const size_t at[3] = {i, row % g->points[1], row / g->points[1]}, p = i + row * g->points[0];
			bool wall = false;
			double sum = -o->f[p];
			for (int d = 0; d < g->dim; d++) {
				bool low = at[d] == 0, high = at[d] == g->cells[d];
				wall = wall || low || high;
				sum += (low ? u[p + step[d]] : high ? u[p - step[d]] : 0) / (g->h[d] * g->h[d]);
			}
			o->charge[p] = wall ? sum : 0;
		}
}

int pm_james_values(struct pm_james *o, double c, const double *s, const double *phi, const double **wall, const double **f)
{
	size_t n = pm_grid_size(&o->grid);
	for (size_t p = 0; p < n; p++)
		o->f[p] = c * s[p];
	induced(o, phi);
	memset(o->wall, 0, n * sizeof *o->wall);
	int status = pm_mg_faces_apply(o->faces, o->charge, o->wall);
	if (!status)
		pm_mg_lift(&o->walled, &o->stencil, o->wall, o->f);
	*wall = o->wall;
	*f = o->f;
	return status;
}
