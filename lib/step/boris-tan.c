/* Boris with the tangent corrected: as boris, but the two halves turn v by exactly Omega dt/2 each, where boris turns by atan(Omega dt/2). A gyration has the
 * right period then, 2 pi/Omega, for any step; the drift E x B/B^2 of fields that differ is no longer exact.
 * Source: Boris 1970; Birdsall and Langdon 1985, section 4-4 (the factor tan(Omega dt/2)/(Omega dt/2)). Assumes v << c. Cost: a tangent more than boris.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step-parts/boris-half.h"
#include "step-parts/plain-pass.h"
#include "step/step.h"

PM_SIMD_INLINE void angles(pm_simd t2, pm_simd *part, pm_simd *turn)
{
	for (int l = 0; l < PM_SIMD_WIDTH; l++) {
		const double half = sqrt(t2[l]);
		(*part)[l] = half > 0 ? tan(0.5 * half) / half : 0;
	}
	*turn = 2 / (1 + t2 * *part * *part);
}

PM_SIMD_INLINE void kick(bool closing, double dt, const struct pm_magnetic_lanes *p) { pm_boris_half(closing, dt, p, angles); }

static void magnetic(bool closing, double dt, size_t from, size_t to, const struct pm_magnetic *m)
{
	PM_MAGNETIC_HALVES(m, from, to, kick, closing, dt)
}

const struct pm_step step_boris_tan = {
	.name = "boris-tan",
	.sentence = "boris with the exact angle of gyration (boris-tan/2)",
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
