/* Drift: positions advance at fixed velocity, x += v dt/N (or vel, where a set has no v).
 * Source: Hockney and Eastwood 1988, section 4-4 (leapfrog); Tuckerman et al. 1992 (kick and drift as factors of the propagator).
 * For the combination of the two see kick. Cost: 3 words of memory traffic per component.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step-parts/plain-pass.h"
#include "step/step.h"

const struct pm_step step_drift = {
	.name = "drift",
	.sentence = "advance positions at fixed velocity",
	.source = "Hockney and Eastwood 1988, 4-4",
	.kind = PM_DRIFT,
	.passes = 1,
	.order = 2,
	.real_limit = NAN,
	.imaginary_limit = 2,
	.at = {1},
	.pass = pm_plain_pass,
};
