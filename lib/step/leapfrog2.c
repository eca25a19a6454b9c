/* Leapfrog of two steps, the explicit midpoint rule: y(t + dt) = y(t - dt) + 2 dt f(y(t)); what is kept is the last change over dt, so that it goes through
 * the faces of a box as a rate does. Started, and restarted after anything else has moved the particles or changed dt, with a step of midpoint.
 * Source: Hairer, Norsett and Wanner 1993, section III.3 (Nystrom). Second order, one pass, one register kept.
 * Stable on the imaginary axis up to 1 alone: of a decay the second root grows without bound.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

static void pass(int p, double dt, size_t n, double *restrict y, const double *restrict k, double *const *q)
{
	(void)p;
	double *restrict last = q[0];
	for (size_t i = 0; i < n; i++) {
		last[i] = 2 * k[i] - last[i];
		y[i] += dt * last[i];
	}
}

const struct pm_step step_leapfrog2 = {
	.name = "leapfrog2",
	.sentence = "leapfrog scheme of two steps, second order, for oscillations alone",
	.source = "Hairer, Norsett and Wanner 1993, III.3",
	.kind = PM_SCHEME,
	.passes = 1,
	.rates = 1,
	.changes = true,
	.start = "midpoint",
	.order = 2,
	.real_limit = 0,
	.imaginary_limit = 1,
	.at = {1},
	.pass = pass,
};
