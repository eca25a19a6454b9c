/* Derivatives of the function that particles carry, at the particles, by the integral operator (docs/methods/pgrad.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_NEAR_DERIVATIVE_H
#define PM_NEAR_DERIVATIVE_H

#include "cell/cell-list.h"

enum { PM_DERIVATIVE_DEGREE = 4 };

struct pm_derivative {
	int dim, order;   /* 1, 2, 3; 2, 4, 6 or 8 */
	int power[3];     /* of each axis; the sum, the degree, is 1 to 4 */
	double eps;       /* [length] of the Gaussian exp(-(r/eps)^2/4) */
	bool plus;        /* f_q + f_p instead of f_q - f_p: of odd degree conserves the total, and diverges on points that are not a lattice */
	const uint64_t *here; /* [2] the first particle that is wanted, and the one behind the last; NULL: all. Rates are of these alone */
	int axis, side;   /* partners on one side alone (-1 below, +1 above along axis), twice; 0 both. Of a first derivative, then of order 1 */
};

/* rate[p] += sum over q of volume_q (f_q -/+ f_p) D^power W_eps(x_p - x_q), partners and images within the list's reach. Not conserving but with plus. The
 * same bytes for any number of threads. 0 or failure. */
int pm_derivative_add(const struct pm_derivative *o, const struct pm_cell_list *l, const double *volume, const double *f, double *rate);

#endif
