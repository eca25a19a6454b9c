/* Boris: v' = acc + (q/m) v x B. Half a step (boris/2) is half of the rotation and half of the kick: the opening half (before the drift)
 * rotates, then kicks; the closing half kicks, then rotates. Each rotates by atan(Omega dt/2), half the angle of the published step, so that a
 * closing half and the next opening half are that step: E/2, rotation by 2 atan(Omega dt/2), E/2.
 * Source: Boris 1970; Birdsall and Langdon 1985, section 4-4; notes in docs/methods/boris.md.
 * Assumes v << c. Second order, keeps |v| without E to round-off, moves at exactly E x B/B^2 in uniform fields. Cost: an inverse root and
 * two divisions a particle. SPDX-License-Identifier: GPL-3.0-or-later */
#include "step-parts/boris-half.h"
#include "step-parts/plain-pass.h"
#include "step/step.h"

PM_SIMD_INLINE void angles(pm_simd t2, pm_simd *part, pm_simd *turn)
{
	const pm_simd slower = pm_simd_rsqrt(1 + t2);
	*part = 1 / (1 + (1 + t2) * slower); /* tan of half of atan |t| */
	*turn = 1 + slower;
}

PM_SIMD_INLINE void kick(bool closing, double dt, const struct pm_magnetic_lanes *p) { pm_boris_half(closing, dt, p, angles); }

static void magnetic(bool closing, double dt, size_t from, size_t to, const struct pm_magnetic *m)
{
	PM_MAGNETIC_HALVES(m, from, to, kick, closing, dt)
}

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
