/* How far particles are from a lattice. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_REMESH_DISTORTION_H
#define PM_REMESH_DISTORTION_H

#include "mesh/planes.h"
#include "transfer/transfer-frame.h"

/* H[p] = sum over particles j of volume_j zeta(x_p - x_j): the overlap of the particles around p, 1 on a lattice. volume
 * NULL: each has a cell. Particles outside the mesh have 0. planes: NULL, or those of this rank, with a part of the particles (all ranks call). 0 or failure
 * (memory). */
int pm_overlap(const struct pm_grid *g, const struct pm_planes *planes, size_t n, const double *const x[], const double *volume, double *H);

/* (1/N) sum |H - H0|/H0 over a set that has x, of its state volume and overlap (H0, stored by remesh) if it has them, else one cell and 1. The fields
 * are held. 0 particles: 0. Negative: failure. */
int pm_distortion(const struct pm_frame *f, const char *set, const struct pm_mesh *m, double *distortion);
/* The largest of several sets, nan if one of them has nan; 0 for none. 0 or failure. */
int pm_distortion_most(const struct pm_frame *f, const struct pm_sets *sets, const struct pm_mesh *m, double *distortion);

#endif
