/* Boris with the tangent corrected: as boris, but the two halves turn v by exactly Omega dt/2 each, where boris turns by atan(Omega dt/2). A gyration has the
 * right period then, 2 pi/Omega, for any step; the drift E x B/B^2 of fields that differ is no longer exact.
 * Source: Boris 1970; Birdsall and Langdon 1985, section 4-4 (the factor tan(Omega dt/2)/(Omega dt/2)). Assumes v << c. Cost: a tangent more than boris.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step-parts/boris-half.h"
#include "step-parts/plain-pass.h"
#include "step/step.h"

static void angle(const double t[3], double t2, double tau[3])
{
	const double half = sqrt(t2), factor = half > 0 ? tan(0.5 * half) / half : 0;
	for (int c = 0; c < 3; c++)
		tau[c] = factor * t[c];
}

static void magnetic(bool closing, double dt, size_t from, size_t to, const struct pm_magnetic *m) { pm_boris_half(closing, dt, from, to, m, angle); }

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
