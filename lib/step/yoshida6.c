/* Yoshida's sixth-order composition of seven leapfrog steps, his solution A.
 * Source: Yoshida 1990, Phys. Lett. A 150, 262, table 1; Hairer, Lubich and Wanner 2006, V.3.2. Symplectic and reversible where the force depends on
 * positions only. Eight passes, no register.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

static const double kicks[] = {0.39225680523878, 0.5100434119184585, -0.4710533854097565, 0.068753168252518, 0.068753168252518, -0.4710533854097565,
	0.5100434119184585, 0.39225680523878};
static const double drifts[] = {0.78451361047756, 0.235573213359357, -1.17767998417887, 1.315186320683906, -1.17767998417887, 0.235573213359357,
	0.78451361047756, 0};

const struct pm_step step_yoshida6 = {
	.name = "yoshida6",
	.sentence = "symplectic composition of seven leapfrog steps, sixth order",
	.source = "Yoshida 1990",
	.kind = PM_SCHEME,
	.passes = 8,
	.order = 6,
	.imaginary_limit = 2.2690579958,
	.kicks = kicks,
	.drifts = drifts,
};
