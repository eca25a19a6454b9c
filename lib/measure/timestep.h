/* What limits the time step: speeds and changes of particles, the strain of a flow on a mesh, the plasma frequency. All are absolute values, and the same
 * for any
 * number of threads. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_TIMESTEP_H
#define PM_MEASURE_TIMESTEP_H

#include "mesh/grid.h"

/* Largest |y|^2 over the particles of a field or, with h (of as many axes as y has components, 3 at most), largest |y_d|/h_d. */
double pm_most(const struct pm_field *y, const double *h);
/* Largest |grad u| on a mesh, 1/time: over points and components of sum_d |du_c/dx_d|, by differences of order 2, one-sided at the last nodes. */
double pm_strain(const struct pm_grid *g, int components, const double *const u[]);
/* sum q^2/m over the particles of a set, from its strength and mass. */
double pm_charge_over_mass(size_t n, const double *q, const double *m);

#endif
