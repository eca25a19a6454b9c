/* The geometry of a mesh with the faces of its box.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "mesh/grid.h"

struct pm_grid pm_grid_of(const struct pm_frame *f, const struct pm_mesh *m)
{
	struct pm_grid g = {.dim = f->dim};
	for (int d = 0; d < 3; d++) {
		bool used = d < f->dim;
		g.cells[d] = used ? m->cells[d] : 1;
		g.lo[d] = used ? m->lo[d] : 0;
		g.h[d] = used ? m->h[d] : 1;
		for (int side = 0; side < 2; side++)
			g.face[d][side] = used ? f->face[d][side] : PM_PERIODIC;
		g.points[d] = used && g.face[d][0] != PM_PERIODIC ? g.cells[d] + 1 : g.cells[d];
	}
	return g;
}

double pm_grid_cell(const struct pm_grid *g)
{
	double volume = 1;
	for (int d = 0; d < g->dim; d++)
		volume *= g->h[d];
	return volume;
}

double pm_grid_weight(const struct pm_grid *g, size_t i, size_t j, size_t k)
{
	const size_t at[3] = {i, j, k};
	double weight = 1;
	for (int d = 0; d < g->dim; d++)
		if (g->points[d] > g->cells[d] && (at[d] == 0 || at[d] == g->cells[d]))
			weight *= 0.5;
	return weight;
}
