/* Conjugate gradients preconditioned by symmetric successive over-relaxation: z from one sweep of sor forward and one back on -lap z = r, from zero.
 * Source: Axelsson 1972; Saad 2003, section 10.2. With a factor near 2/(1 + 2 sin(pi/(2n))) the number of sweeps is of order sqrt(n) instead of n; each
 * costs about three of cg. factor 1: symmetric Gauss-Seidel. No formula is given for the radius. In 3-D on any number of threads, else the two sweeps are
 * serial. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "relax-parts/conjugate-gradients.h"
#include "relax-parts/lexicographic-sweep.h"
#include "relax-parts/young-theory.h"

/* Axelsson's: 2/(1 + sqrt(2 (1 - mu))), a little below Young's. */
static double factor(const struct pm_laplacian *l) { return 2 / (1 + sqrt(2 * (1 - pm_young_mu(l)))); }

static double radius(const struct pm_laplacian *l, double relaxation)
{
	(void)l, (void)relaxation;
	return NAN;
}

/* lap z = r, so that z has the other sign; a factor of M changes nothing. */
static void precondition(struct pm_relax_work *w, const double *r, double *z)
{
	memset(z, 0, w->lap->size * sizeof *z);
	pm_lexicographic_sweep(w->lap, w->factor, z, r, w->sums, true);
	pm_lexicographic_sweep(w->lap, w->factor, z, r, w->sums, false);
}

static double sweep(struct pm_relax_work *w) { return pm_gradients_sweep(w, precondition); }

const struct pm_relax relax_ssor_cg = {
	.name = "ssor-cg",
	.sentence = "conjugate gradients preconditioned by a symmetric sweep of over-relaxation",
	.source = "Axelsson 1972; Saad 2003, section 10.2",
	.bound = true,
	.extra = 4,
	.factor = factor,
	.radius = radius,
	.sweep = sweep,
};
