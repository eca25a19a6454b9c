/* Krasny's denominator core: delta^2 added under the denominator, u = (-y, x)/(2 pi (r^2 + delta^2)); phi = ln(r^2 + delta^2)/(4 pi).
 * Source: Krasny 1986, J. Fluid Mech. 167, 65; notes on particle methods, S4-6. 2-D only; g(s) = s^2/(1+s^2).
 * The blob 1/(pi (1+s^2)^2) has an algebraic tail: force/bare - 1 = -(delta/r)^2. SPDX-License-Identifier: GPL-3.0-or-later */
#include "mollifier/bare.h"

static double force(double r2, double delta, int dim) { return pm_bare_force(r2 + delta * delta, dim); }

static double potential(double r2, double delta, int dim) { return pm_bare_potential(r2 + delta * delta, dim); }

const struct pm_mollifier mollifier_krasny = {
	.name = "krasny",
	.sentence = "delta^2 under the denominator of the vortex kernel",
	.source = "Krasny 1986",
	.dims = 1u << 2,
	.force = force,
	.potential = potential,
	.order = 2,
	.square = true,
};
