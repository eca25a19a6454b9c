/* Jacobi's iteration: every node gets the value that solves its equation for the old values of its neighbours:
 *   u <- u + (lap u - f)/diagonal
 * Source: Jacobi 1845; Varga 1962, section 3.1. Radius max |sum w cos(k h)/sum w|: (cos(pi/M) + cos(pi/N))/2 on a square with walls, 1 - pi^2/(2 n^2) in 1-D.
 * If no face fixes u and the nodes can alternate in sign, that wave has the eigenvalue -1: no convergence. Any number of threads.
 * Cost: N per sweep, of order n^2 sweeps. SPDX-License-Identifier: GPL-3.0-or-later */
#include "relax-parts/jacobi-sweep.h"

static double factor(const struct pm_laplacian *l)
{
	(void)l;
	return 1;
}

const struct pm_relax relax_jacobi = {
	.name = "jacobi",
	.sentence = "every node from the old values of its neighbours",
	.source = "Jacobi 1845; Varga 1962, section 3.1",
	.extra = 1,
	.factor = factor,
	.in_planes = true,
	.radius = pm_jacobi_radius,
	.sweep = pm_jacobi_sweep,
};
