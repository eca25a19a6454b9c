/* Young's theory of successive over-relaxation, for matrices in which Jacobi's eigenvalues come in pairs +mu, -mu and the order of the nodes is consistent:
 * row by row or red and black, between wall and neumann faces; red and black also on a periodic axis of even length.
 *   (lambda + omega - 1)^2 = omega^2 mu^2 lambda        (printed with a damaged exponent in some notes: the formula for +- gives sqrt(lambda))
 * Source: Young 1954; Varga 1962, section 4.3. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_YOUNG_THEORY_H
#define PM_YOUNG_THEORY_H

#include "mesh/laplacian.h"

double pm_young_mu(const struct pm_laplacian *l);
double pm_young_best(const struct pm_laplacian *l);
double pm_young_radius(const struct pm_laplacian *l, double factor);

#endif
