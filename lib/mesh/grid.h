/* The geometry of a mesh with the faces of its box: the arguments of the numerical rooms, which do not use frames.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_GRID_H
#define PM_MESH_GRID_H

#include "stream/frame.h"

PM_C_BEGIN

struct pm_grid {
	int dim;
	size_t cells[3];  /* 1 above dim */
	size_t points[3]; /* cells on a periodic axis, cells+1 on any other, 1 above dim; x runs fastest in memory */
	double lo[3];     /* [length] of point 0 */
	double h[3];      /* [length] spacing, 1 above dim */
	enum pm_face face[3][2]; /* both periodic or neither */
};

struct pm_grid pm_grid_of(const struct pm_frame *f, const struct pm_mesh *m);
static inline size_t pm_grid_size(const struct pm_grid *g) { return g->points[0] * g->points[1] * g->points[2]; }
/* Walls count as neumann faces: values are continued evenly beyond them. */
static inline void pm_grid_even(struct pm_grid *g)
{
	for (int d = 0; d < g->dim; d++)
		for (int side = 0; side < 2; side++)
			g->face[d][side] = g->face[d][side] == PM_WALL ? PM_NEUMANN : g->face[d][side];
}
double pm_grid_cell(const struct pm_grid *g); /* volume of a cell, over dim axes */
/* Quadrature weight of a point: 1, times 1/2 for each non-periodic axis on whose end it sits. */
double pm_grid_weight(const struct pm_grid *g, size_t i, size_t j, size_t k);

PM_C_END

#endif
