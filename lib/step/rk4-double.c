/* Step doubling with the classical scheme of order 4: one step of dt and two of dt/2 from the same point; their difference is the error of the step
 * (push/embedded-run.c), and the state at the end is that of the two. With an error alpha dt^5 of the long step the short ones have alpha dt^5/16, the
 * difference is alpha dt^5 (1 - 1/16). As an embedded pair: 11 rates, those of the long step first, and that at the end.
 * Source: Press, Teukolsky, Vetterling and Flannery 1992, section 16.2, without the extrapolation to order 5; the scheme: Kutta 1901.
 * Twelve passes a step, eleven after a rejection, against seven of rk45: for comparison, and where a scheme that is known well is wanted.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

#define HALF 1.0 / 12, 0, 0, 0, 1.0 / 6, 1.0 / 6, 1.0 / 12 /* weights of the first step of dt/2 */

static const struct pm_embedded pair = {
	.stages = 12,
	.order = 4,
	.at = {0, 0.5, 0.5, 1, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1},
	.a = {{0}, {0.5}, {0, 0.5}, {0, 0, 1},
		{0.25}, {0, 0, 0, 0, 0.25}, {0, 0, 0, 0, 0, 0.5},
		{HALF}, {HALF, 0.25}, {HALF, 0, 0.25}, {HALF, 0, 0, 0.5},
		{HALF, 1.0 / 12, 1.0 / 6, 1.0 / 6, 1.0 / 12}},
	.error = {1.0 / 12 - 1.0 / 6, -1.0 / 3, -1.0 / 3, -1.0 / 6, 1.0 / 6, 1.0 / 6, 1.0 / 12, 1.0 / 12, 1.0 / 6, 1.0 / 6, 1.0 / 12},
};

const struct pm_step step_rk4_double = {
	.name = "rk4-double",
	.sentence = "classical Runge-Kutta of order 4 with error control by step doubling",
	.source = "Kutta 1901; Press et al. 1992",
	.kind = PM_SCHEME,
	.passes = 12,
	.registers = 1 + 12,
	.order = 4,
	.real_limit = NAN,
	.embedded = &pair,
};
