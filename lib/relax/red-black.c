/* Red-black Gauss-Seidel: first all nodes with i + j + k even, then all others with the new values of these.
 * Source: Young 1954; Varga 1962, section 4.1. Radius: the square of Jacobi's, as in the order of memory, also on periodic axes of even length; a sweep does
 * not depend on the direction or the threads. It smooths better than the order of memory (poisson-mg). Cost: N per sweep, of order n^2 sweeps.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "relax-parts/red-black-sweep.h"

static double factor(const struct pm_laplacian *l)
{
	(void)l;
	return 1;
}

const struct pm_relax relax_red_black = {
	.name = "red-black",
	.sentence = "Gauss-Seidel on every second node, then on the others",
	.source = "Young 1954; Varga 1962, section 4.1",
	.factor = factor,
	.in_planes = true,
	.radius = pm_red_black_radius,
	.sweep = pm_red_black_sweep,
};
