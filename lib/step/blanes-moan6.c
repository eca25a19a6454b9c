/* Blanes and Moan's sixth-order composition SRKN11b, optimised for forces that depend on positions only (Runge-Kutta-Nystrom).
 * Source: Blanes and Moan 2002, J. Comput. Appl. Math. 142, 313, table 3. Symplectic and reversible. Twelve passes, no register.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

static const double kicks[] = {0.0414649985182624, 0.198128671918067, -0.0400061921041533, 0.0752539843015807, -0.0115113874206879, 0.2366699247869311,
	0.2366699247869311, -0.0115113874206879, 0.0752539843015807, -0.0400061921041533, 0.198128671918067, 0.0414649985182624};
static const double drifts[] = {0.123229775946271, 0.290553797799558, -0.127049212625417, -0.246331761062075, 0.357208872795928, 0.20477705429147,
	0.357208872795928, -0.246331761062075, -0.127049212625417, 0.290553797799558, 0.123229775946271, 0};

const struct pm_step step_blanes_moan6 = {
	.name = "blanes-moan6",
	.sentence = "optimised symplectic composition, sixth order",
	.source = "Blanes and Moan 2002, SRKN11b",
	.kind = PM_SCHEME,
	.passes = 12,
	.order = 6,
	.imaginary_limit = 3.1415,
	.kicks = kicks,
	.drifts = drifts,
};
