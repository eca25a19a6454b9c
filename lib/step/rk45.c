/* Embedded pair of orders 5 and 4 with its step chosen by its error (push/embedded-run.c); the step is taken with order 5.
 * Source: Dormand and Prince 1980, J. Comp. Appl. Math. 6, 19; the polynomial between the ends: Hairer, Norsett and Wanner 1993, section II.6 (DOPRI5).
 * Seven passes a step, six after a rejection: the rate at the end is asked for again at the next beginning, because the sentence makes a rate in every pass.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

static const struct pm_embedded pair = {
	.stages = 7,
	.order = 4,
	.at = {0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1},
	.a = {{0}, {1.0 / 5}, {3.0 / 40, 9.0 / 40}, {44.0 / 45, -56.0 / 15, 32.0 / 9},
		{19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
		{9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
		{35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}},
	.error = {71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40},
	.dense = {-12715105075.0 / 11282082432, 0, 87487479700.0 / 32700410799, -10690763975.0 / 1880347072, 701980252875.0 / 199316789632,
		-1453857185.0 / 822651844, 69997945.0 / 29380423},
};

const struct pm_step step_rk45 = {
	.name = "rk45",
	.sentence = "Runge-Kutta pair of orders 5 and 4 with error control",
	.source = "Dormand and Prince 1980",
	.kind = PM_SCHEME,
	.passes = 7,
	.registers = 1 + 7,
	.order = 5,
	.real_limit = NAN,
	.embedded = &pair,
};
