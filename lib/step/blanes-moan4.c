/* Blanes and Moan's fourth-order composition S6 of kicks and drifts, optimised: its error terms are some hundred times smaller than Yoshida's.
 * Source: Blanes and Moan 2002, J. Comput. Appl. Math. 142, 313, table 2. Symplectic and reversible where the force depends on positions only.
 * Seven passes, no register.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

static const double kicks[] = {0.0792036964311957, 0.353172906049774, -0.0420650803577195, 0.2193769557534996, -0.0420650803577195, 0.353172906049774,
	0.0792036964311957};
static const double drifts[] = {0.209515106613362, -0.143851773179818, 0.434336666566456, 0.434336666566456, -0.143851773179818, 0.209515106613362, 0};

const struct pm_step step_blanes_moan4 = {
	.name = "blanes-moan4",
	.sentence = "optimised symplectic composition, fourth order",
	.source = "Blanes and Moan 2002, S6",
	.kind = PM_SCHEME,
	.passes = 7,
	.order = 4,
	.imaginary_limit = 3.1328233979,
	.kicks = kicks,
	.drifts = drifts,
};
