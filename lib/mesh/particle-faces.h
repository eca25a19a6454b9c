/* The effect of the faces of the box on particles along one axis. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_PARTICLE_FACES_H
#define PM_MESH_PARTICLE_FACES_H

#include "stream/frame.h"

/* Folds x [length] into [lo, hi): hi itself, and values that round to it, become lo. */
void pm_particle_faces_fold(size_t n, double lo, double hi, double *x);

/* Mirrors x at the faces marked, until it is inside [lo, hi], and changes the sign of the nw arrays w (velocities, and
 * registers of a scheme; NULL ones are left out) once per mirroring. */
void pm_particle_faces_reflect(size_t n, double lo, double hi, const bool mirror[2], double *x, int nw, double *const *w);

/* Marks gone[i] = 1 where x is beyond a face that absorbs. */
void pm_particle_faces_absorb(size_t n, double lo, double hi, const bool absorb[2], const double *x, unsigned char *gone);

#endif
