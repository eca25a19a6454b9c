/* Embedded pair of orders 3 and 2 with its step chosen by its error (push/embedded-run.c); the step is taken with order 3. For loose tolerances.
 * Source: Bogacki and Shampine 1989, Appl. Math. Lett. 2, 321; between the ends the cubic through the values and rates there.
 * Four passes a step, three after a rejection.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

static const struct pm_embedded pair = {
	.stages = 4,
	.order = 2,
	.at = {0, 0.5, 0.75, 1},
	.a = {{0}, {0.5}, {0, 0.75}, {2.0 / 9, 1.0 / 3, 4.0 / 9}},
	.error = {-5.0 / 72, 1.0 / 12, 1.0 / 9, -1.0 / 8},
};

const struct pm_step step_rk23 = {
	.name = "rk23",
	.sentence = "Runge-Kutta pair of orders 3 and 2 with error control",
	.source = "Bogacki and Shampine 1989",
	.kind = PM_SCHEME,
	.passes = 4,
	.registers = 1 + 4,
	.order = 3,
	.real_limit = NAN,
	.embedded = &pair,
};
