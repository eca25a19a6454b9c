/* Vay's relativistic kick: (gamma v)' = acc + (q/m) v x B, with v x B the mean of both ends of the step, so that a particle drifts at exactly E x B/B^2 at any
 * gamma. Half a step (vay/2): the closing half, after the drift, is explicit, u += dt/2 (acc + q/m v x B); the opening half solves for the v at its end.
 * A closing half and the next opening half are the published step. The frame keeps v; c is its constant.
 * Source: Vay 2008, Physics of Plasmas 15, 056701. Second order; does not keep volume in phase space. Cost: five square roots a particle.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step-parts/plain-pass.h"
#include "step-parts/proper-velocity.h"
#include "step/step.h"

PM_SIMD_INLINE void kick(bool closing, double dt, const struct pm_magnetic_lanes *p)
{
	double changed[3][PM_MAGNETIC_LANES];
	for (size_t l = 0; l < PM_MAGNETIC_LANES; l++) {
		double u[3], tau[3];
		pm_proper_load(p, l, u);
		pm_proper_angle(p, dt, l, tau);
		if (closing)
			pm_proper_cross(p, tau, u);
		pm_proper_kick(p, dt, l, u);
		if (!closing)
			pm_proper_solve(p, tau, u);
		pm_proper_store(p, l, u, changed);
	}
	pm_magnetic_put(p, changed);
}

static void magnetic(bool closing, double dt, size_t from, size_t to, const struct pm_magnetic *m)
{
	PM_MAGNETIC_HALVES(m, from, to, kick, closing, dt)
}

const struct pm_step step_vay = {
	.name = "vay",
	.sentence = "half a step of relativistic velocities that drift at E x B/B^2 (vay/2)",
	.source = "Vay 2008",
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
