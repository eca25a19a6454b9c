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
/* pm_operator_apply where the ranks may share the mesh: in, out and the weights have the values of `field` that are here. Called by all ranks in the same
 * order; a failure is of this rank alone. */
int pm_operator_apply_planes(const struct pm_operator *o, double factor, const struct pm_field *field, const double *const in[], double *const out[],
	bool *seen);
/* Weights of the order/2 pairs of nodes, near to far, of a term of a scalar's first derivatives. */
void pm_operator_pairs(const struct pm_operator *o, int term, double factor, double w[3]);
/* Do images of a component change sign at a face? */
bool pm_operator_odd(const struct pm_operator *o, int component, int axis, int side);

#endif
