/* What gradient-operator.c, gradient.c and gradient-spectral.c share. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_GRADIENT_PARTS_H
#define PM_MESH_GRADIENT_PARTS_H

#include "mesh/gradient.h"
#include "mesh/planes.h"

/* All of out, by differences and by transforms. */
int pm_operator_differences(const struct pm_operator *o, double factor, const double *const in[], double *const out[], bool *seen);
int pm_operator_spectral(const struct pm_operator *o, double factor, const double *const in[], double *const out[]);
/* With o->planes out and in have the planes of a rank, in also those of the neighbours that are read, so many on either side. */
int pm_operator_reach(const struct pm_operator *o, const struct pm_planes *planes);
/* Do images of a component change sign at a face? */
bool pm_operator_odd(const struct pm_operator *o, int component, int axis, int side);

#endif
