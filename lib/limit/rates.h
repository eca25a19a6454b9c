/* What limits the time step: speeds and changes of particles, the strain of a flow on a mesh, frequencies. All are absolute values, and the same for any
 * number of threads. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LIMIT_RATES_H
#define PM_LIMIT_RATES_H

#include "law/law.h"

/* Largest |y|^2 over the particles of a field or, with h (of as many axes as y has components, 3 at most), largest |y_d|/h_d. */
double pm_most(const struct pm_field *y, const double *h);
/* Largest |grad u| on a mesh, 1/time: over points and components of sum_d |du_c/dx_d|, by differences of order 2, one-sided at the last nodes. */
double pm_strain(const struct pm_grid *g, const struct pm_field *field, const double *const u[]);
/* The same of a component at n points of a row of a mesh in the plane, between the points on either side of them and those of the rows below and above. */
double pm_strain_in_plane(const struct pm_grid *g, size_t n, const double *here, const double *below, const double *above);
/* sum q^2/m over the particles of a set, from its strength and mass. */
double pm_charge_over_mass(size_t n, const double *q, const double *m);
/* omega_p of the sets of a frame that move and have the law's strength and `per`, both loaded; 0 if there are none. */
double pm_plasma_frequency(const struct pm_frame *f, const struct pm_law *law);
/* sum |strength| over all sets of the frame that have it; those that are not uniform must be loaded. */
double pm_strength_total(const struct pm_frame *f, const char *strength);
/* What a change of size `most` says of orbits, from the total `pull` (|coefficient| sum |strength|) alone: it comes from within a distance r at most,
 * most = pull/(2 (dim - 1) pi r^(dim - 1)), so that something turns at most/r or faster: the square of a frequency if the change is an acceleration, a strain
 * if it is a velocity. 0 where nothing can be said, as in 1-D. */
double pm_orbit_rate(int dim, double most, double pull);

#endif
