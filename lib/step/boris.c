/* Boris: v' = acc + (q/m) v x B. Half a step (boris/2) is half of the rotation and half of the kick: the opening half (before the drift)
 * rotates, then kicks; the closing half kicks, then rotates. Each rotates by atan(Omega dt/2), half the angle of the published step, so that a
 * closing half and the next opening half are that step: E/2, rotation by 2 atan(Omega dt/2), E/2.
 * Source: Boris 1970; Birdsall and Langdon 1985, section 4-4; notes in docs/methods/boris.md.
 * Assumes v << c. Second order, keeps |v| without E to round-off, moves at exactly E x B/B^2 in uniform fields. Cost: one square root and
 * two divisions a particle. SPDX-License-Identifier: GPL-3.0-or-later */
#include "step-parts/boris-half.h"
#include "step-parts/plain-pass.h"
#include "step/step.h"

static void angle(const double t[3], double t2, double tau[3])
{
	for (int c = 0; c < 3; c++)
		tau[c] = t[c] / (1 + sqrt(1 + t2)); /* tan of half of atan |t| */
}

static void magnetic(bool closing, double dt, size_t from, size_t to, const struct pm_magnetic *m) { pm_boris_half(closing, dt, from, to, m, angle); }

const struct pm_step step_boris = {
	.name = "boris",
	.sentence = "half a step of velocities in electric and magnetic fields (boris/2)",
	.source = "Boris 1970",
	.kind = PM_KICK,
	.passes = 1,
	.order = 2,
	.real_limit = NAN,
	.imaginary_limit = 2,
	.at = {1},
	.pass = pm_plain_pass,
	.magnetic = magnetic,
};
