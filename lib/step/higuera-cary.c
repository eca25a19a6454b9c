/* Higuera and Cary's relativistic kick: (gamma v)' = acc + (q/m) v x B, with v x B from the mean of u = gamma v at both ends of the rotation. It drifts at
 * E x B/B^2 as vay and keeps volume in phase space as boris. Half a step (higuera-cary/2): the closing half, after the drift, kicks and solves for the mean;
 * the opening half rotates on from the mean and kicks. A closing half and the next opening half are the published step. The frame keeps v; c is its constant.
 * Source: Higuera and Cary 2017, Physics of Plasmas 24, 052104. Second order. Cost: five square roots a particle. SPDX-License-Identifier: GPL-3.0-or-later */
#include "step-parts/plain-pass.h"
#include "step-parts/proper-velocity.h"
#include "step/step.h"

PM_SIMD_INLINE void kick(bool closing, double dt, const struct pm_magnetic_lanes *p)
{
	double changed[3][PM_MAGNETIC_LANES];
	for (size_t l = 0; l < PM_MAGNETIC_LANES; l++) {
		double u[3];
		pm_proper_load(p, l, u);
		pm_proper_higuera_cary(p, closing, dt, l, u);
		pm_proper_store(p, l, u, changed);
	}
	pm_magnetic_put(p, changed);
}

static void magnetic(bool closing, double dt, size_t from, size_t to, const struct pm_magnetic *m)
{
	PM_MAGNETIC_HALVES(m, from, to, kick, closing, dt)
}

const struct pm_step step_higuera_cary = {
	.name = "higuera-cary",
	.sentence = "half a step of relativistic velocities that drift at E x B/B^2 and keep volume (higuera-cary/2)",
	.source = "Higuera and Cary 2017",
	.kind = PM_KICK,
	.passes = 1,
	.order = 2,
	.real_limit = NAN,
	.imaginary_limit = 2,
	.at = {1},
	.pass = pm_plain_pass,
	.magnetic = magnetic,
	.relativistic = true,
};
