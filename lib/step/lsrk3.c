/* Williamson's low-storage third-order Runge-Kutta, scheme no. 7: q = a_p q + dt k, y += b_p q with a = (0, -5/9, -153/128),
 * b = (1/3, 15/16, 8/15); the register holds q/dt.
 * Source: Williamson 1980, J. Comput. Phys. 35, 48, table 1 (where +153/128 is printed, the weights add to 1.57 and the scheme is not
 * even consistent).
 * Three passes, one register: two words per state, the least for third order.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

static void pass(int p, double dt, size_t n, double *restrict y, const double *restrict k, double *const *q)
{
	static const double a[] = {0, -5.0 / 9, -153.0 / 128}, b[] = {1.0 / 3, 15.0 / 16, 8.0 / 15};
	double *restrict w = q[0], c = a[p], step = b[p] * dt;
	for (size_t i = 0; i < n; i++) {
		w[i] = c * w[i] + k[i];
		y[i] += step * w[i];
	}
}

const struct pm_step step_lsrk3 = {
	.name = "lsrk3",
	.sentence = "Williamson's low-storage Runge-Kutta scheme no. 7, third order",
	.source = "Williamson 1980",
	.kind = PM_SCHEME,
	.passes = 3,
	.registers = 1,
	.order = 3,
	.real_limit = 2.512745326618329,
	.imaginary_limit = 1.7320508075688772,
	.at = {1.0 / 3, 3.0 / 4, 1},
	.pass = pass,
};
