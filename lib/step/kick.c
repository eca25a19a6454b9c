/* Kick: every state but the positions advances by its rate, v += acc dt/N, s += s' dt/N.
 * Source: Hockney and Eastwood 1988, section 4-4 (leapfrog); Tuckerman et al. 1992 (kick and drift as factors of the propagator).
 * With drift: kick/2 drift | force | kick/2 is velocity Verlet, second order, symplectic and reversible if the force depends on
 * positions only, stable up to omega dt = 2. Cost: 3 words of memory traffic per component.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step-parts/plain-pass.h"
#include "step/step.h"

const struct pm_step step_kick = {
	.name = "kick",
	.sentence = "advance velocities and strengths at fixed positions",
	.source = "Hockney and Eastwood 1988, 4-4",
	.kind = PM_KICK,
	.passes = 1,
	.order = 2,
	.real_limit = NAN,
	.imaginary_limit = 2,
	.at = {1},
	.pass = pm_plain_pass,
};
