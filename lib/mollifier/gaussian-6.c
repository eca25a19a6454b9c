/* Gaussian blob of order 6, without its second and fourth moments: with the blob g of order 2, g - delta^2/4 lap g + delta^4/32 lap lap g, in the plane
 * (3 - 3 s^2 + s^4/2) exp(-s^2)/(pi delta^2), s = r/delta; its transform is (1 + a + a^2/2) exp(-a), a = (k delta)^2/4. So all of its kernels are those
 * of gaussian and a polynomial times g: phi - delta^2 g (1/4 + dim/16 - s^2/8), f + g (1/2 + (dim + 2)/8 - s^2/4), slope + g/delta^2 (s^2/2 - 11/4).
 * Source: Beale and Majda 1985, J. Comput. Phys. 58, 188, section 2. Bare to round-off beyond 7.5 delta. SPDX-License-Identifier: GPL-3.0-or-later */
#include "mollifier/bare.h"

extern const struct pm_mollifier mollifier_gaussian;

static const double root_pi = 1.77245385090551602730, reach = 7.5; /* the slope in 3-D differs there by 0.4 s^7 exp(-s^2), 2e-19 */

static double blob(double s2, double delta, int dim)
{
	const double line = 1 / (root_pi * delta);
	return exp(-s2) * (dim == 1 ? line : dim == 2 ? line * line : line * line * line);
}

static bool far(double r2, double delta) { return r2 >= reach * reach * (delta * delta); }

static double force(double r2, double delta, int dim)
{
	const double s2 = r2 / (delta * delta);
	return far(r2, delta) ? pm_bare_force(r2, dim) :
		mollifier_gaussian.force(r2, delta, dim) + (0.5 + 0.125 * (dim + 2) - 0.25 * s2) * blob(s2, delta, dim);
}

static double potential(double r2, double delta, int dim)
{
	const double s2 = r2 / (delta * delta);
	return far(r2, delta) ? pm_bare_potential(r2, dim) :
		mollifier_gaussian.potential(r2, delta, dim) - delta * delta * (0.25 + dim / 16. - 0.125 * s2) * blob(s2, delta, dim);
}

static double slope(double r2, double delta)
{
	const double s2 = r2 / (delta * delta);
	return far(r2, delta) ? pm_bare_slope(r2) :
		mollifier_gaussian.slope(r2, delta) + (0.5 * s2 - 2.75) * blob(s2, delta, 3) / (delta * delta);
}

const struct pm_mollifier mollifier_gaussian_6 = {
	.name = "gaussian-6",
	.sentence = "a Gaussian blob of order 6, exp(-(r/delta)^2) without its second and fourth moments",
	.source = "Beale and Majda 1985",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.force = force,
	.potential = potential,
	.slope = slope,
	.reach = 7.5,
};
