/* Implicit Euler: y1 = y0 + dt f(y1), found by iteration (push/implicit-run.c).
 * Source: Hairer and Wanner 1996, section IV.3. A- and L-stable: every decay is damped, and so is every oscillation, by 1/sqrt(1 + (omega dt)^2) a step.
 * A pass at the start, then one per iteration.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

static const struct pm_implicit implicit = {.start = 0, .part = 1, .beyond = 1, .at = 1};

const struct pm_step step_implicit_euler = {
	.name = "implicit-euler",
	.sentence = "implicit Euler scheme, first order, damps every decay",
	.source = "Hairer and Wanner 1996, IV.3",
	.kind = PM_SCHEME,
	.passes = 4,
	.registers = PM_IMPLICIT_REGISTERS,
	.order = 1,
	.real_limit = INFINITY,
	.imaginary_limit = INFINITY,
	.implicit = &implicit,
};
