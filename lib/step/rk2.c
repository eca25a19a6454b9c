/* Heun's second-order Runge-Kutta: y1 = y0 + dt k1, y = y0 + dt/2 (k1 + k2), written as increments so that the register holds k1.
 * Source: Heun 1900; Springel and Graeter, notes, section 2.4.
 * Second order; oscillations grow like (omega dt)^4/8 per step, and so does the radius of a round vortex, which midpoint keeps. Two passes, one register.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

static void pass(int p, double dt, size_t n, double *restrict y, const double *restrict k, double *const *q)
{
	double *restrict k1 = q[0];
	if (p == 0)
		for (size_t i = 0; i < n; i++)
			y[i] += dt * k[i], k1[i] = k[i];
	else
		for (size_t i = 0; i < n; i++)
			y[i] += 0.5 * dt * (k[i] - k1[i]);
}

const struct pm_step step_rk2 = {
	.name = "rk2",
	.sentence = "Heun's Runge-Kutta scheme, second order (for vortices: midpoint)",
	.source = "Heun 1900",
	.kind = PM_SCHEME,
	.passes = 2,
	.registers = 1,
	.fills = true,
	.order = 2,
	.real_limit = 2,
	.imaginary_limit = 0,
	.doubling = 0.995642361818,
	.at = {1, 1},
	.pass = pass,
};
