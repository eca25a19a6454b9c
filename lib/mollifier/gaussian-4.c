/* Gaussian blob of order 4, with its second moment removed: pi^(-dim/2) delta^-dim ((dim + 2)/2 - s^2) exp(-s^2), s = r/delta; negative beyond
 * s = sqrt((dim + 2)/2). With the blob g of order 2 it is g - delta^2/4 lap g, so that all of its kernels are those of gaussian and a multiple of g:
 * phi - delta^2/4 g, f + g/2, slope - g/delta^2. Source: Beale and Majda 1985, J. Comput. Phys. 58, 188, section 2.
 * Bare to round-off beyond 7 delta. SPDX-License-Identifier: GPL-3.0-or-later */
#include "mollifier/bare.h"

extern const struct pm_mollifier mollifier_gaussian;

static const double root_pi = 1.77245385090551602730;
enum { REACH2 = 49 }; /* 7^2: the slope in 3-D still differs by 4/3 s^5/sqrt(pi) exp(-s^2), 7e-18 */

static double blob(double r2, double delta, int dim)
{
	const double line = 1 / (root_pi * delta);
	return exp(-r2 / (delta * delta)) * (dim == 1 ? line : dim == 2 ? line * line : line * line * line);
}

static double force(double r2, double delta, int dim)
{
	if (r2 >= REACH2 * (delta * delta))
		return pm_bare_force(r2, dim);
	return mollifier_gaussian.force(r2, delta, dim) + 0.5 * blob(r2, delta, dim);
}

static double potential(double r2, double delta, int dim)
{
	if (r2 >= REACH2 * (delta * delta))
		return pm_bare_potential(r2, dim);
	return mollifier_gaussian.potential(r2, delta, dim) - 0.25 * delta * delta * blob(r2, delta, dim);
}

static double slope(double r2, double delta)
{
	if (r2 >= REACH2 * (delta * delta))
		return pm_bare_slope(r2);
	return mollifier_gaussian.slope(r2, delta) - blob(r2, delta, 3) / (delta * delta);
}

const struct pm_mollifier mollifier_gaussian_4 = {
	.name = "gaussian-4",
	.sentence = "a Gaussian blob of order 4, exp(-(r/delta)^2) without its second moment",
	.source = "Beale and Majda 1985",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.force = force,
	.potential = potential,
	.slope = slope,
	.loop = PM_LOOP_GAUSSIAN_4,
	.reach = 7,
};
