/* Planes of a divided mesh for which each rank asks, wherever they are: for reads whose places no rank knows beforehand, as of particles in any order.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_PLANES_SOME_H
#define PM_MESH_PLANES_SOME_H

#include "mesh/planes.h"

struct pm_some_planes {
	const double **at; /* [components][planes of the mesh]: the values of a plane; NULL where it was not wanted */
	double *room;      /* of those of other ranks */
};

/* Of n components, those planes of the mesh where wanted[] is not 0. Not divided: all of them, without a copy. Takes the caller's status and returns the agreed
 * one (world/world.h); free in any case. */
int pm_planes_some(int status, const struct pm_planes *p, const unsigned char *wanted, int n, const double *const in[], struct pm_some_planes *s);
void pm_planes_some_free(struct pm_some_planes *s);

/* How many planes a rank asks for at once, so that it never holds many more than its own, also where its particles are
 * everywhere. width: of what reads them. */
size_t pm_planes_at_once(const struct pm_planes *p, size_t width);

#endif
