/* Young's theory of successive over-relaxation, for matrices in which Jacobi's eigenvalues come in pairs +mu, -mu and the order of the nodes is consistent:
 * row by row or red and black, between walls and neumann faces; red and black also round an even periodic axis.
 *   (lambda + omega - 1)^2 = omega^2 mu^2 lambda        (printed with a damaged exponent in some notes: the formula for +- gives sqrt(lambda))
 * Source: Young 1954; Varga 1962, section 4.3. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_RELAX_YOUNG_H
#define PM_RELAX_YOUNG_H

#include "relax/relax.h"

static inline double pm_young_mu(const struct pm_laplacian *l) { return fmax(l->highest, 0); }

static inline double pm_young_best(const struct pm_laplacian *l)
{
	double mu = pm_young_mu(l);
	return 2 / (1 + sqrt(1 - mu * mu));
}

static inline double pm_young_radius(const struct pm_laplacian *l, double factor)
{
	double mu = pm_young_mu(l), under = factor * factor * mu * mu - 4 * (factor - 1);
	if (under <= 0)
		return factor - 1;
	double root = (factor * mu + sqrt(under)) / 2;
	return fmax(root * root, fabs(factor - 1)); /* |factor - 1|: modes with mu = 0, and under-relaxation */
}

#endif
