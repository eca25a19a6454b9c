/* Algebraic blob of high order, 2 (2 - s^2)/(pi (1 + s^2)^4)/delta^2: f = (s^4 + 3 s^2 + 4)/(2 pi delta^2 (1 + s^2)^3),
 * phi = (ln(r^2 + delta^2) - 1/(1+s^2) - 1/(1+s^2)^2)/(4 pi). Its second moment vanishes, so a smooth field is changed by O(delta^4) only.
 * Source: Koumoutsakos, notes on particle methods, section 2.2 (S06). 2-D only; negative beyond s = sqrt(2); force/bare - 1 = -(delta/r)^4.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "mollifier/bare.h"

static double force(double r2, double delta, int dim)
{
	(void)dim;
	double d2 = delta * delta, w = 1 + r2 / d2, a = r2 / d2 / w; /* a <= 1: powers of r2 overflow */
	return d2 > 0 ? (a * a + (3 * a + 4 / w) / w) / (2 * pm_pi * d2 * w) : pm_bare_force(r2, 2);
}

static double potential(double r2, double delta, int dim)
{
	(void)dim;
	double d2 = delta * delta, w = 1 + r2 / d2;
	return d2 > 0 ? (log(r2 + d2) - (1 + 1 / w) / w) / (4 * pm_pi) : pm_bare_potential(r2, 2);
}

const struct pm_mollifier mollifier_algebraic = {
	.name = "algebraic",
	.sentence = "an algebraic blob whose second moment vanishes",
	.source = "Koumoutsakos, notes, section 2.2",
	.dims = 1u << 2,
	.force = force,
	.potential = potential,
	.order = 4,
};
