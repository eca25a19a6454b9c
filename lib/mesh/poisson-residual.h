/* What an approximation leaves of lap phi = c s. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_POISSON_RESIDUAL_H
#define PM_MESH_POISSON_RESIDUAL_H

#include "mesh/grid.h"

/* r = c s - lap phi on the unknowns, 0 on walls, with differences of order 2; phi counts as 0 on walls (known values belong to s). NULL: phi is 0 everywhere.
 * Where no face fixes phi the mean of r, which no phi can reach, is taken out. *size and *source: root mean squares of r and of c s. 0 or -PM_DATA. */
int pm_poisson_residual(const struct pm_grid *g, double c, const double *s, const double *phi, double *r, double *size, double *source);

#endif
