/* The lattice Green's function of one open axis, exact inverse of the second difference: (G_{i+1} - 2 G_i + G_{i-1})/h^2 - kappa^2 G_i = delta_i0/h has
 * the solution G_i = -h exp(-q |i|)/(2 sinh q), 2 sinh(q/2) = kappa h; for kappa = 0 it is |x|/2, with nothing at 0.
 * kappa^2 is that of the differences along the other axes, so that the whole is their exact inverse. Cost: an exponential per node.
 * Source: by insertion; Gillis, Winckelmans and Chatelain 2018 for its use.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "green/green.h"

static double at(const struct pm_green_case *c, double r2)
{
	double h = c->h[0], q = 2 * asinh(0.5 * c->kappa * h);
	return q > 0 ? -h * exp(-q * sqrt(r2) / h) / (2 * sinh(q)) : 0.5 * sqrt(r2);
}

const struct pm_green green_lattice = {
	.name = "lattice",
	.sentence = "the exact inverse of the second difference, one open axis",
	.source = "Gillis, Winckelmans and Chatelain 2018",
	.order = 2,
	.plain = 1u << 1,
	.screened = 1u << 1,
	.differences = true,
	.at = at,
};
