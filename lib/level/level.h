/* Level sets carried by particles with volumes: the level on the nodes of a mesh, the region where it is below 0 (docs/methods/redistance.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LEVEL_H
#define PM_LEVEL_H

#include "mesh/planes.h"

struct pm_level_measures {
	double inside;     /* [length^dim] where the level is below 0 */
	double interface;  /* [length^(dim - 1)] where it is 0: points, perimeter, surface */
	double difference; /* [length^dim] where one of two levels is below 0 and the other is not; NAN with one */
};

/* sum V level W/sum V W on the nodes by m4prime, so that particles on nodes keep their values; NAN on a node to which the particles give less than a tenth
 * of a cell. x[d][n], volume[n], level[n], node[points]. The mesh has no walls (pm_grid_even). Where ranks share its planes, n and
 * the nodes are those here, and all call. 0 or failure, agreed. */
int pm_level_on_mesh(const struct pm_grid *g, const struct pm_planes *planes, size_t n, const double *const x[], const double *volume, const double *level,
	double *node);
/* Of levels on the nodes, linear along each axis in between; b NULL: none. Cells with a NAN corner do not count. Order 2 in h. Ranks as above. 0 or
 * failure, agreed. */
int pm_level_measure(const struct pm_grid *g, const struct pm_planes *planes, const double *a, const double *b, struct pm_level_measures *m);

#endif
