/* Rankine core: a slab, disc or ball of constant density and radius delta; f = 1/(2 delta), 1/(2 pi delta^2), 1/(4 pi delta^3) inside, the bare
 * kernel outside. In 2-D solid rotation inside, potential flow outside. In 2-D phi = (ln delta + (s^2 - 1)/2)/(2 pi) inside.
 * Source: Rankine 1858; notes on particle methods, S4-5. Equal to the bare kernel beyond delta; the force has a kink there.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "mollifier/bare.h"

static double force(double r2, double delta, int dim)
{
	double d2 = delta * delta;
	return r2 >= d2 ? pm_bare_force(r2, dim) : pm_bare_force(d2, dim);
}

static double potential(double r2, double delta, int dim)
{
	double d2 = delta * delta, s2 = r2 / d2;
	if (r2 >= d2)
		return pm_bare_potential(r2, dim);
	if (dim == 1)
		return 0.25 * delta * (1 + s2);
	return dim == 2 ? (log(delta) + 0.5 * (s2 - 1)) / (2 * pm_pi) : -(3 - s2) / (8 * pm_pi * delta);
}

static double slope(double r2, double delta) { return r2 >= delta * delta ? pm_bare_slope(r2) : 0; }

const struct pm_mollifier mollifier_rankine = {
	.name = "rankine",
	.sentence = "a ball of constant density and radius delta",
	.source = "Rankine 1858",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.force = force,
	.potential = potential,
	.slope = slope,
	.reach = 1,
};
