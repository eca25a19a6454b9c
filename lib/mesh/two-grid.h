/* Between a mesh and the one of twice the spacing: full weighting, linear interpolation. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_TWO_GRID_H
#define PM_MESH_TWO_GRID_H

#include "mesh/grid.h"

/* 0, or a failure that says which axis cannot: an odd number of cells, faces open or absorbing. */
int pm_two_grid_check(const struct pm_grid *fine);
struct pm_grid pm_two_grid_coarse(const struct pm_grid *fine);
/* coarse = R fine, by (1 2 1)/4 along every axis, values folded at the faces; 0 on walls. Constants stay. */
void pm_two_grid_restrict(const struct pm_grid *fine, const double *from, double *coarse);
/* fine += P coarse, linear along every axis; walls are left alone. R = 2^-dim P^T, with the weights of quadrature. */
void pm_two_grid_prolong(const struct pm_grid *fine, const double *coarse, double *to);

#endif
