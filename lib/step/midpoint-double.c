/* Step doubling with Runge's midpoint scheme, as rk4-double: two steps of dt/2 against one of dt, difference alpha dt^3 (1 - 1/4). For loose tolerances.
 * Source: Press, Teukolsky, Vetterling and Flannery 1992, section 16.2; the scheme: Runge 1895.
 * Six passes a step, five after a rejection.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

static const struct pm_embedded pair = {
	.stages = 6,
	.order = 2,
	.at = {0, 0.5, 0.25, 0.5, 0.75, 1},
	.a = {{0}, {0.5}, {0.25}, {0, 0, 0.5}, {0, 0, 0.5, 0.25}, {0, 0, 0.5, 0, 0.5}},
	.error = {0, -1, 0.5, 0, 0.5},
};

const struct pm_step step_midpoint_double = {
	.name = "midpoint-double",
	.sentence = "midpoint scheme of order 2 with error control by step doubling",
	.source = "Runge 1895; Press et al. 1992",
	.kind = PM_SCHEME,
	.passes = 6,
	.registers = 1 + 6,
	.order = 2,
	.real_limit = NAN,
	.embedded = &pair,
};
