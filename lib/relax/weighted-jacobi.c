/* Weighted Jacobi: a fraction of Jacobi's step, u <- u + (factor/diagonal)(lap u - f), by default 2/3, 4/5, 6/7 in 1, 2, 3 dimensions.
 * These damp all waves shorter than four nodes best, by 1/3, 3/5, 5/7 per sweep on equal spacings, which is why multigrid smooths with them; long waves
 * are damped less than by Jacobi: 1 - factor pi^2 h^2/2 in 1-D whatever the factor. Converges for 0 < factor <= 1, also if Jacobi's does not.
 * Source: Briggs, Henson, McCormick 2000, chapter 2; Trottenberg, Oosterlee, Schueller 2001, section 2.1. Any number of threads.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "relax-parts/jacobi-sweep.h"

/* d/(d + 1/2): makes the eigenvalues at the two ends of the short waves, 1 - factor/d and 1 - 2 factor, opposite. */
static double factor(const struct pm_laplacian *l) { return l->dim / (l->dim + 0.5); }

const struct pm_relax relax_weighted_jacobi = {
	.name = "weighted-jacobi",
	.sentence = "a part of Jacobi's step, by default the one that shrinks short waves best",
	.source = "Briggs, Henson, McCormick 2000, chapter 2",
	.extra = 1,
	.factor = factor,
	.in_planes = true,
	.radius = pm_jacobi_radius,
	.sweep = pm_jacobi_sweep,
};
