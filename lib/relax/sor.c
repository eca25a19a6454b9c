/* Successive over-relaxation: Gauss-Seidel's step times a factor, u_i <- u_i + omega (lap u - f)_i/diagonal, in the order of memory.
 * By default omega = 2/(1 + sqrt(1 - mu^2)), mu the largest of Jacobi's eigenvalues on this mesh with these faces (the constant left out where the problem is
 * singular); the radius is then omega - 1, about 1 - 2 pi/n: of order n sweeps. Below it Young's formula, above it omega - 1 (lib/relax-parts/young-theory.c).
 * Source: Young 1954; Frankel 1950. At the best factor errors first grow by a factor of order n, because two eigenvectors coincide there.
 * In 3-D by diagonals of rows on any number of threads, else serial. SPDX-License-Identifier: GPL-3.0-or-later */
#include "relax-parts/lexicographic-sweep.h"
#include "relax-parts/young-theory.h"

const struct pm_relax relax_sor = {
	.name = "sor",
	.sentence = "successive over-relaxation in the order of memory, by default with Young's best factor",
	.source = "Young 1954",
	.factor = pm_young_best,
	.radius = pm_lexicographic_radius,
	.sweep = pm_lexicographic_relax,
};
