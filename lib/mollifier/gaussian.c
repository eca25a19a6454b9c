/* Gaussian blob pi^(-dim/2) delta^-dim exp(-s^2), s = r/delta. Fraction of the strength inside r: erf(s) in 1-D, 1 - exp(-s^2) in 2-D,
 * erf(s) - 2 s exp(-s^2)/sqrt(pi) in 3-D; phi = (r erf(s) + delta exp(-s^2)/sqrt(pi))/2, (ln r^2 + E1(s^2))/(4 pi), -erf(s)/(4 pi r).
 * Source: notes on particle methods, S4-6 and S06 (the convention of variance delta^2/2 per axis); Abramowitz and Stegun 5.1.11 for E1.
 * Bare to round-off beyond 6.5 delta. SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_sf_expint.h>

#include "mollifier/bare.h"

static const double root_pi = 1.77245385090551602730;
enum { REACH2 = 42 }; /* 6.5^2: exp(-42) = 6e-19 */

/* 3 sqrt(pi)/4 (erf(s) - 2 s exp(-s^2)/sqrt(pi))/s^3 = 1 - 3/5 s^2 + 3/14 s^4 - ...; the difference cancels below s = 1. */
static double series(double s2)
{
	double sum = 0, power = 1;
	for (int k = 0; k < 20; k++) {
		sum += power * 3 / (2 * k + 3);
		power *= -s2 / (k + 1);
	}
	return sum;
}

static double force(double r2, double delta, int dim)
{
	double d2 = delta * delta, s2 = r2 / d2, s = sqrt(s2);
	if (r2 >= REACH2 * d2)
		return pm_bare_force(r2, dim);
	if (dim == 1)
		return (s < 1e-9 ? 2 / root_pi : erf(s) / s) / (2 * delta);
	if (dim == 2)
		return (s2 < 1e-18 ? 1 : -expm1(-s2) / s2) / (2 * pm_pi * d2);
	double part = s2 < 1 ? 4 / (3 * root_pi) * series(s2) : (erf(s) - 2 * s * exp(-s2) / root_pi) / (s * s2);
	return part / (4 * pm_pi * d2 * delta);
}

/* ln s^2 + E1(s^2), -Euler's gamma at 0. */
static double log_e1(double s2)
{
	if (s2 > 1)
		return log(s2) + gsl_sf_expint_E1(s2);
	double sum = -0.57721566490153286061, term = -1;
	for (int k = 1; k < 22; k++) {
		term *= -s2 / k;
		sum += term / k;
	}
	return sum;
}

static double potential(double r2, double delta, int dim)
{
	double d2 = delta * delta, s2 = r2 / d2, s = sqrt(s2);
	if (r2 >= REACH2 * d2)
		return pm_bare_potential(r2, dim);
	if (dim == 1)
		return 0.5 * delta * (s * erf(s) + exp(-s2) / root_pi);
	if (dim == 2)
		return (2 * log(delta) + log_e1(s2)) / (4 * pm_pi);
	return -(s < 1e-9 ? 2 / root_pi : erf(s) / s) / (4 * pm_pi * delta);
}

/* (4 exp(-s^2)/sqrt(pi) - 3 F)/s^2 of F = 4 pi delta^3 f; below s = 1 by the series of the derivative. */
static double slope(double r2, double delta)
{
	double d2 = delta * delta, s2 = r2 / d2, sum = 0, power = 1;
	if (r2 >= REACH2 * d2)
		return pm_bare_slope(r2);
	for (int k = 0; k < 20 && s2 < 1; k++) {
		sum -= power * 6 / (2 * k + 5);
		power *= -s2 / (k + 1);
	}
	double part = s2 < 1 ? 4 / (3 * root_pi) * sum : (4 / root_pi * exp(-s2) - 12 * pm_pi * d2 * delta * force(r2, delta, 3)) / s2;
	return part / (4 * pm_pi * d2 * d2 * delta);
}

const struct pm_mollifier mollifier_gaussian = {
	.name = "gaussian",
	.sentence = "a Gaussian blob exp(-(r/delta)^2)",
	.source = "Beale and Majda 1985",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.force = force,
	.potential = potential,
	.slope = slope,
	.loop = PM_LOOP_GAUSSIAN,
	.reach = 6.5,
};
