/* A level made the signed distance from its interface (docs/methods/redistance.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_REDISTANCE_H
#define PM_REDISTANCE_H

#include "mesh/grid.h"

struct pm_redistance {
	size_t crossed; /* nodes beside the interface; 0: there is none, and nothing was changed */
	size_t linear;  /* of those the ones whose nearest point was taken from crossings of the mesh lines, because Newton's method failed (edges, corners) */
	size_t unsettled; /* particles whose distance is that from a point of a node around, because the search from there did not settle */
};

/* node[points]: the level, all finite; x[d][n], level[n]: replaced by the signed distance of the particles. The mesh has no walls (pm_grid_even). 0 or
 * failure (memory). The same bytes for any number of threads. */
int pm_redistance(const struct pm_grid *g, const double *node, size_t n, const double *const x[], double *level, struct pm_redistance *report);

#endif
