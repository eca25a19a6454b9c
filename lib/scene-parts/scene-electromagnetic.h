/* What scenes of electromagnetic plasmas share: units in which c = eps0 = 1 and electrons of density 1 have q = -1, m = 1, so that omega_p = 1; fields on
 * Yee's mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SCENE_ELECTROMAGNETIC_H
#define PM_SCENE_ELECTROMAGNETIC_H

#include "scene-parts/scene-plasma.h"

/* The law, a periodic box 0..length on every axis, and the mesh with the cells typed, or `cells` on each axis; dt is half of h/c. */
int pm_scene_em_world(const struct pm_scene_choice *c, struct pm_frame *f, double length, size_t cells, double background);
/* E and B of zeros; their components are filled by value(component, x, data) at the points where these sit. */
int pm_scene_em_fields(struct pm_frame *f, double (*electric)(int c, const double x[3], const void *data),
	double (*magnetic)(int c, const double x[3], const void *data), const void *data);
/* Three components normal to (k, k, ..) of `axes` equal components, along z x k; and k x that. */
void pm_scene_em_polarisation(int axes, double across[3], double third[3]);
#endif
