/* Algebraic blobs of high order, s = r/delta. 2-D: 2 (2 - s^2)/(pi (1 + s^2)^4)/delta^2: f = (s^4 + 3 s^2 + 4)/(2 pi delta^2 (1 + s^2)^3),
 * phi = (ln(r^2 + delta^2) - 1/(1+s^2) - 1/(1+s^2)^2)/(4 pi); negative beyond s = sqrt(2). 3-D: 15/(8 pi (1 + s^2)^(7/2))/delta^3:
 * f = (s^2 + 5/2)/(4 pi delta^3 (1 + s^2)^(5/2)), phi = -(s^2 + 3/2)/(4 pi delta (1 + s^2)^(3/2)); positive.
 * Source: 2-D Koumoutsakos, notes on particle methods, section 2.2 (S06), where the second moment vanishes; 3-D Winckelmans and Leonard 1993, equation (12),
 * the usual core of vortex particles. force/bare - 1 = -(delta/r)^4 and -15/8 (delta/r)^4. SPDX-License-Identifier: GPL-3.0-or-later */
#include "mollifier/bare.h"

static double force(double r2, double delta, int dim)
{
	double d2 = delta * delta, w = 1 + r2 / d2, a = r2 / d2 / w; /* a <= 1: powers of r2 overflow */
	if (d2 <= 0)
		return pm_bare_force(r2, dim);
	if (dim == 3)
		return (1 + 1.5 / w) / (4 * pm_pi * d2 * delta * w * sqrt(w));
	return (a * a + (3 * a + 4 / w) / w) / (2 * pm_pi * d2 * w);
}

static double potential(double r2, double delta, int dim)
{
	double d2 = delta * delta, w = 1 + r2 / d2;
	if (d2 <= 0)
		return pm_bare_potential(r2, dim);
	if (dim == 3)
		return -(1 + 0.5 / w) / (4 * pm_pi * delta * sqrt(w));
	return (log(r2 + d2) - (1 + 1 / w) / w) / (4 * pm_pi);
}

static double slope(double r2, double delta)
{
	double d2 = delta * delta, w = 1 + r2 / d2;
	return d2 > 0 ? -(3 + 7.5 / w) / (4 * pm_pi * d2 * d2 * delta * w * w * sqrt(w)) : pm_bare_slope(r2);
}

const struct pm_mollifier mollifier_algebraic = {
	.name = "algebraic",
	.sentence = "an algebraic blob of order 4 in 2-D, that of Winckelmans and Leonard in 3-D",
	.source = "Koumoutsakos, notes, section 2.2; Winckelmans and Leonard 1993",
	.dims = 1u << 2 | 1u << 3,
	.force = force,
	.potential = potential,
	.slope = slope,
	.order = 4,
	.loop = PM_LOOP_ALGEBRAIC,
};
