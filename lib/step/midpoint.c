/* The midpoint rule, Runge's second-order scheme: y1 = y0 + dt/2 k1, y = y0 + dt k2, written as increments so that the register holds k1.
 * Source: Runge 1895; Hairer, Norsett and Wanner 1993, table II.1.1.
 * Second order. For a linear oscillation it is rk2 (growth (omega dt)^4/8 per step). A round vortex, whose inner pass is evaluated at a radius larger by
 * (omega dt)^2/8 and so turns slower, keeps its size: for a ring of vortices exactly. Two passes, one register.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

static void pass(int p, double dt, size_t n, double *restrict y, const double *restrict k, double *const *q)
{
	double *restrict k1 = q[0];
	if (p == 0)
		for (size_t i = 0; i < n; i++)
			y[i] += 0.5 * dt * k[i], k1[i] = k[i];
	else
		for (size_t i = 0; i < n; i++)
			y[i] += dt * (k[i] - 0.5 * k1[i]);
}

const struct pm_step step_midpoint = {
	.name = "midpoint",
	.sentence = "midpoint rule, second order, which keeps round vortices",
	.source = "Runge 1895",
	.kind = PM_SCHEME,
	.passes = 2,
	.registers = 1,
	.fills = true,
	.order = 2,
	.real_limit = 2,
	.imaginary_limit = 0,
	.doubling = 0.995642361818,
	.at = {0.5, 1},
	.pass = pass,
};
