/* Adams-Bashforth of two steps: y += dt/2 (3 k - k'), k' the rate of the step before. Started, and restarted after anything else has moved the
 * particles or changed dt, with a step of rk2.
 * Source: Bashforth and Adams 1883; Hairer, Norsett and Wanner 1993, section III.1.
 * Second order, one pass; weakly unstable for oscillations (growth (omega dt)^4/4 per step). Keeps one old rate.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

static void pass(int p, double dt, size_t n, double *restrict y, const double *restrict k, double *const *q)
{
	(void)p;
	const double *restrict k1 = q[0];
	for (size_t i = 0; i < n; i++)
		y[i] += dt * (1.5 * k[i] - 0.5 * k1[i]);
}

const struct pm_step step_ab2 = {
	.name = "ab2",
	.sentence = "Adams-Bashforth scheme, second order, one pass per step",
	.source = "Bashforth and Adams 1883",
	.kind = PM_SCHEME,
	.passes = 1,
	.rates = 1,
	.start = "rk2",
	.order = 2,
	.real_limit = 1,
	.imaginary_limit = 0,
	.doubling = 0.600758887359,
	.at = {1},
	.pass = pass,
};
