/* The lattice Green's function: the exact inverse of the centred differences of --symbol, in open space and with some open axes. One open axis and the second
 * difference: (G_{i+1} - 2 G_i + G_{i-1})/h^2 - kappa^2 G_i = delta_i0/h has the solution G_i = -h exp(-q |i|)/(2 sinh q), 2 sinh(q/2) = kappa h; for kappa
 * = 0 it is |x|/2, which is 0 at 0. All others have no closed form and come from the solver's integral of heat kernels (lib/poisson-fft/fft-lattice.c), with
 * the same additive constant as the free-space functions. Cost: an exponential per node, else 250 products.
 * Source: by insertion; Gillis, Winckelmans and Chatelain 2018, Liska and Colonius 2014 for its use.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "green/green.h"

static double at(const struct pm_green_case *c, double r2)
{
	double h = c->h[0], q = 2 * asinh(0.5 * c->kappa * h);
	return q > 0 ? -h * exp(-q * sqrt(r2) / h) / (2 * sinh(q)) : 0.5 * sqrt(r2);
}

const struct pm_green green_lattice = {
	.name = "lattice",
	.sentence = "the exact inverse of centred differences",
	.source = "Gillis, Winckelmans and Chatelain 2018; Liska and Colonius 2014",
	.order = 2,
	.plain = 1u << 1 | 1u << 2 | 1u << 3,
	.screened = 1u << 1 | 1u << 2 | 1u << 3,
	.differences = true,
	.at = at,
};
