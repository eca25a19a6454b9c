/* Transforms over the open axes of the free-space Green's functions cut off at distance R: entire functions of k, so sampling them on
 * a mesh of frequencies that is fine enough (period = R + box) is exact. With K^2 = k^2 + kappa^2, kappa > 0 and kappa = 0:
 *   3-D -(1 - exp(-kappa R)(cos kR + kappa sin(kR)/k))/K^2              -2 sin^2(kR/2)/k^2
 *   2-D -(1 + R (k J1(kR) K0(kappa R) - kappa J0(kR) K1(kappa R)))/K^2  R ln(R) J1(kR)/k - (1 - J0(kR))/k^2
 *   1-D -(1 - exp(-kappa R)(cos kR - k sin(kR)/kappa))/K^2              (kR sin kR - 2 sin^2(kR/2))/k^2
 * Source: Vico, Greengard and Ferrando 2016, equations 10-14 for kappa = 0. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_GREEN_PARTS_TRUNCATED_H
#define PM_GREEN_PARTS_TRUNCATED_H

#include <gsl/gsl_sf_bessel.h>

#include "green/green.h"

/* constant[0], [1]: exp(-kappa R), or K0 and K1 of kappa R. */
static inline void pm_truncated_prepare(struct pm_green_case *c)
{
	double x = c->kappa * c->reach;
	c->constant[0] = exp(-x);
	if (c->dim == 2 && x > 0) {
		c->constant[1] = c->constant[0] * gsl_sf_bessel_K1_scaled(x);
		c->constant[0] *= gsl_sf_bessel_K0_scaled(x);
	}
}

static inline double pm_truncated_screened(const struct pm_green_case *c, double k)
{
	double R = c->reach, x = k * R, K2 = k * k + c->kappa * c->kappa, e = c->constant[0];
	if (e < 1e-18)
		return -1 / K2;
	if (c->dim == 1)
		return -(1 - e * (cos(x) - k / c->kappa * sin(x))) / K2;
	if (c->dim == 2)
		return -(1 + R * (k * j1(x) * e - c->kappa * j0(x) * c->constant[1])) / K2;
	return -(1 - e * (cos(x) + c->kappa * (k > 0 ? sin(x) / k : R))) / K2;
}

static inline double pm_truncated(const struct pm_green_case *c, double k2)
{
	double k = sqrt(k2), R = c->reach, x = k * R;
	if (c->kappa > 0)
		return pm_truncated_screened(c, k);
	if (c->dim == 1)
		return k > 0 ? (x * sin(x) - 2 * pow(sin(0.5 * x), 2)) / k2 : 0.5 * R * R;
	if (c->dim == 2)
		return k > 0 ? R * log(R) * j1(x) / k - (1 - j0(x)) / k2 : R * R * (0.5 * log(R) - 0.25);
	return k > 0 ? -2 * pow(sin(0.5 * x), 2) / k2 : -0.5 * R * R;
}

#endif
