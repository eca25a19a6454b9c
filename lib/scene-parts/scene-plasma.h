/* Shared by the plasma scenes: units in which omega_p = eps0 = 1 and electrons have q = -1, m = 1 per unit of density 1, so that each of n
 * particles of a box of length L carries the charge -L/n and the mass L/n; ions are a constant background.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SCENE_PLASMA_H
#define PM_SCENE_PLASMA_H

#include "scene-parts/scene-bodies.h"

/* The law and a periodic box 0..length. */
void pm_scene_plasma_world(struct pm_frame *f, double length, double background, double dt);
/* The set "electrons" with x, v of `velocities` components (above dim all 0), mass and charge the same for all. */
int pm_scene_plasma_set(struct pm_frame *f, uint64_t n, int velocities, double charge, double mass, double *x[3], double *v[3]);
/* Charge and mass of each electron, to be filled, where they are not all the same. */
int pm_scene_plasma_weights(struct pm_frame *f, double *weight[2]);
/* A given uniform field on the mesh. */
int pm_scene_plasma_given(struct pm_frame *f, const char *name, const char *unit, int components, const double *value);
/* Parameters that are integers. */
int pm_scene_plasma_whole(double mode, double velocities, int least);
/* x in [0, length). */
double pm_scene_fold(double x, double length);
#endif
