/* No mollifier: the bare kernel of a point, f = 1/(2r), 1/(2 pi r^2), 1/(4 pi r^3). Unbounded as r -> 0; coincident particles exert no force.
 * Source: notes on particle methods, S4-3 (Biot-Savart, Newton, Coulomb). Needs no softening length.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "mollifier/bare.h"

static double force(double r2, double delta, int dim)
{
	(void)delta;
	return pm_bare_force(r2, dim);
}

static double potential(double r2, double delta, int dim)
{
	(void)delta;
	return pm_bare_potential(r2, dim);
}

static double slope(double r2, double delta)
{
	(void)delta;
	return pm_bare_slope(r2);
}

const struct pm_mollifier mollifier_none = {
	.name = "none",
	.sentence = "the bare kernel of a point",
	.source = "Newton 1687",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.force = force,
	.potential = potential,
	.slope = slope,
	.square = true,
	.bare = true,
};
