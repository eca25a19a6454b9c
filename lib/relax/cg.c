/* Conjugate gradients: each sweep minimises the error along a direction conjugate to all earlier ones (lib/relax-parts/conjugate-gradients.c).
 * Source: Hestenes and Stiefel 1952; Shewchuk 1994. The error falls at least by (sqrt K - 1)/(sqrt K + 1) per sweep, K the ratio of the largest to the
 * smallest eigenvalue, about 1 - pi/n: of order n sweeps without a factor to choose, and fewer if the source has few modes. A diagonal (Jacobi's)
 * preconditioner would change nothing: the diagonal is constant. Sums in fixed order: the same bytes on any number of threads. Singular problems: the zero
 * mean of f keeps the iterates away from constants. SPDX-License-Identifier: GPL-3.0-or-later */
#include "relax-parts/conjugate-gradients.h"

static double radius(const struct pm_laplacian *l, double factor)
{
	(void)factor;
	return pm_gradients_bound(l);
}

static double sweep(struct pm_relax_work *w) { return pm_gradients_sweep(w, NULL); }

const struct pm_relax relax_cg = {
	.name = "cg",
	.sentence = "conjugate gradients",
	.source = "Hestenes and Stiefel 1952",
	.bound = true,
	.extra = 3,
	.in_planes = true,
	.radius = radius,
	.sweep = sweep,
};
