/* Yoshida's fourth-order composition of three leapfrog steps, w1 = 1/(2 - 2^(1/3)), w0 = -2^(1/3) w1, w1: the middle one goes backwards.
 * Source: Yoshida 1990, Phys. Lett. A 150, 262; Forest and Ruth 1990. Symplectic and reversible where the force depends on positions only.
 * Four passes, no register; its error is 600 times that of blanes-moan4 at the same step (pendulum), at 4/7 of the cost.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

static const double kicks[] = {0.67560359597982882, -0.17560359597982882, -0.17560359597982882, 0.67560359597982882};
static const double drifts[] = {1.3512071919596576, -1.7024143839193153, 1.3512071919596576, 0};

const struct pm_step step_yoshida4 = {
	.name = "yoshida4",
	.sentence = "symplectic composition of three leapfrog steps, fourth order",
	.source = "Yoshida 1990",
	.kind = PM_SCHEME,
	.passes = 4,
	.order = 4,
	.imaginary_limit = 1.5734019473,
	.kicks = kicks,
	.drifts = drifts,
};
