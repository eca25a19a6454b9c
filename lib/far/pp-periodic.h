/* Direct summation in the plane with one periodic axis (docs/methods/pp.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FAR_PP_PERIODIC_H
#define PM_FAR_PP_PERIODIC_H

#include "base/base.h"

struct pm_pp_periodic {
	int axis;      /* the periodic one, 0 or 1; the other is open */
	double period; /* [length] */
	double delta;  /* [length] each point is the bare one at (r^2 + delta^2)^(1/2); >= 0 */
};

/* For each of the first `targets` of n particles: gradient[c][i] = sum over j != i of q[j] d(phi1)/dx_c (x_i - x_j) and, unless NULL, potential[i] the same
 * sum of phi1, where lap phi1 is the row of delta functions, mollified. *coincident pairs closer than 1e-14 of the period, with delta 0, exert nothing.
 * 0 or failure. */
int pm_pp_periodic_sum(const struct pm_pp_periodic *p, size_t targets, size_t n, const double *const *x, const double *q, double *const *gradient,
	double *potential, uint64_t *coincident);

#endif
