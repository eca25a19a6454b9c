/* Classical fourth-order Runge-Kutta: k2, k3 at the middle, k4 at the end, y = y0 + dt/6 (k1 + 2 k2 + 2 k3 + k4), written as increments:
 * registers hold the rate of the last pass and the weighted sum so far.
 * Source: Kutta 1901; Hairer, Norsett and Wanner 1993, table II.1.2.
 * Four passes, two registers; damps oscillations like (omega dt)^6/144 per step, so energy falls in closed orbits.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

/* The next pass starts at y0 + a dt k; this one at y0 + b dt (last rate); the rate enters the sum with weight w. */
struct row {
	double a, b, w;
};

static void between(struct row r, double dt, size_t n, double *restrict y, const double *restrict k, double *restrict last, double *restrict sum)
{
	for (size_t i = 0; i < n; i++) {
		y[i] += dt * (r.a * k[i] - r.b * last[i]);
		last[i] = k[i];
		sum[i] += r.w * k[i];
	}
}

static void pass(int p, double dt, size_t n, double *restrict y, const double *restrict k, double *const *q)
{
	static const struct row rows[] = {{0.5, 0, 1}, {0.5, 0.5, 2}, {1, 0.5, 2}};
	double *restrict last = q[0], *restrict sum = q[1];
	if (p < 3)
		between(rows[p], dt, n, y, k, last, sum);
	else
		for (size_t i = 0; i < n; i++)
			y[i] += dt * ((sum[i] + k[i]) / 6 - last[i]);
}

const struct pm_step step_rk4 = {
	.name = "rk4",
	.sentence = "classical Runge-Kutta scheme, fourth order",
	.source = "Kutta 1901",
	.kind = PM_SCHEME,
	.passes = 4,
	.registers = 2,
	.order = 4,
	.real_limit = 2.785293563405282,
	.imaginary_limit = 2.8284271247461903,
	.at = {0.5, 0.5, 1, 1},
	.pass = pass,
};
