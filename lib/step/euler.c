/* Explicit Euler: y += dt k. All states advance together from the rates at the start of the step.
 * Source: Hairer, Norsett and Wanner 1993, section I.7.
 * First order; a negative control: circles become spirals, every undamped oscillation grows. One pass, no registers.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step-parts/plain-pass.h"
#include "step/step.h"

const struct pm_step step_euler = {
	.name = "euler",
	.sentence = "explicit Euler, first order",
	.source = "Hairer, Norsett and Wanner 1993, I.7",
	.kind = PM_SCHEME,
	.passes = 1,
	.order = 1,
	.real_limit = 2,
	.imaginary_limit = 0,
	.doubling = 0.226234942147,
	.at = {1},
	.pass = pm_plain_pass,
};
