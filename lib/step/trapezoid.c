/* Trapezoidal rule (Crank and Nicolson 1947): y1 = y0 + dt/2 (f(y0) + f(y1)), found by iteration (push/implicit-run.c).
 * Source: Hairer and Wanner 1996, section IV.3. A-stable; of all A-stable multistep schemes of order 2 it has the smallest error, 1/12 (Dahlquist 1963).
 * A decay much faster than 1/dt changes sign in every step instead of vanishing.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

static const struct pm_implicit implicit = {.start = 0.5, .part = 0.5, .beyond = 1, .at = 1};

const struct pm_step step_trapezoid = {
	.name = "trapezoid",
	.sentence = "trapezoidal rule, second order, stable for any decay",
	.source = "Crank and Nicolson 1947",
	.kind = PM_SCHEME,
	.passes = 4,
	.registers = PM_IMPLICIT_REGISTERS,
	.order = 2,
	.real_limit = INFINITY,
	.imaginary_limit = INFINITY,
	.implicit = &implicit,
};
