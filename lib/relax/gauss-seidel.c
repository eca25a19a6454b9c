/* Gauss-Seidel: node after node in the order of memory, each from the newest values of its neighbours; u_i <- u_i + (lap u - f)_i/diagonal.
 * Source: Seidel 1874; Varga 1962, section 3.1. Radius: the square of Jacobi's, 1 - pi^2/n^2, half the sweeps, in the order of memory between wall and
 * neumann faces; no formula is given for periodic axes. Converges also if Jacobi's iteration does not.
 * In 3-D by diagonals of rows on any number of threads, else serial. Cost: N per sweep, of order n^2 sweeps. SPDX-License-Identifier: GPL-3.0-or-later */
#include "relax-parts/lexicographic-sweep.h"

static double factor(const struct pm_laplacian *l)
{
	(void)l;
	return 1;
}

const struct pm_relax relax_gauss_seidel = {
	.name = "gauss-seidel",
	.sentence = "every node from the newest values of its neighbours, in the order of memory",
	.source = "Seidel 1874; Varga 1962, section 3.1",
	.factor = factor,
	.radius = pm_lexicographic_radius,
	.sweep = pm_lexicographic_relax,
};
