/* Adams-Bashforth of three steps: y += dt/12 (23 k - 16 k' + 5 k''), k' and k'' the rates of the two steps before. Started, and restarted after
 * anything else has moved the particles or changed dt, with two steps of lsrk3.
 * Source: Bashforth and Adams 1883; Durran 1991 (stability: oscillations decay up to omega dt = 0.72).
 * Third order, one pass; keeps two old rates.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

static void pass(int p, double dt, size_t n, double *restrict y, const double *restrict k, double *const *q)
{
	(void)p;
	const double *restrict k1 = q[0], *restrict k2 = q[1];
	for (size_t i = 0; i < n; i++)
		y[i] += dt / 12 * (23 * k[i] - 16 * k1[i] + 5 * k2[i]);
}

const struct pm_step step_ab3 = {
	.name = "ab3",
	.sentence = "Adams-Bashforth scheme, third order, one pass per step",
	.source = "Bashforth and Adams 1883",
	.kind = PM_SCHEME,
	.passes = 1,
	.rates = 2,
	.start = "lsrk3",
	.order = 3,
	.real_limit = 6.0 / 11,
	.imaginary_limit = 0.7236,
	.at = {1},
	.pass = pass,
};
