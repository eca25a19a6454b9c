/* Boris with the tangent corrected: as boris, but the two halves turn v by exactly Omega dt/2 each, where boris turns by atan(Omega dt/2). A gyration has the
 * right period then, 2 pi/Omega, for any step; the drift E x B/B^2 of fields that differ is no longer exact.
 * Source: Boris 1970; Birdsall and Langdon 1985, section 4-4 (the factor tan(Omega dt/2)/(Omega dt/2)). Assumes v << c. Cost: a tangent more than boris.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step-parts/magnetic-turn.h"
#include "step-parts/plain-pass.h"
#include "step/step.h"

static void magnetic(bool closing, double dt, size_t from, size_t to, const struct pm_magnetic *m)
{
	for (size_t i = from; i < to; i++) {
		double v[3], a[3], tau[3], square = 0;
		const double half = 0.5 * dt * m->charge[i] / m->mass[i];
		for (int c = 0; c < 3; c++) {
			v[c] = pm_magnetic_component((const double *const *)m->v, c, i);
			a[c] = 0.5 * dt * pm_magnetic_component(m->acc, c, i);
			tau[c] = half * pm_magnetic_component(m->b, c, i);
			square += tau[c] * tau[c];
			v[c] += closing ? a[c] : 0;
		}
		const double angle = sqrt(square), factor = angle > 0 ? tan(0.5 * angle) / angle : 0;
		for (int c = 0; c < 3; c++)
			tau[c] *= factor;
		pm_magnetic_turn(tau, v);
		for (int c = 0; c < 3; c++)
			if (m->v[c])
				m->v[c][i] = v[c] + (closing ? 0 : a[c]);
	}
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
