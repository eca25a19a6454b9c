/* Relativistic kick: (gamma v)' = acc + (q/m) v x B, gamma = 1/sqrt(1 - v^2/c^2), split like boris: half a step (relativistic/2) is half of the rotation,
 * by the frequency Omega/gamma, and half of the kick of u = gamma v; the opening half rotates, then kicks, the closing half kicks, then rotates.
 * Without a magnetic field only the kick. The frame keeps v; c is its constant.
 * Source: Boris 1970; Birdsall and Langdon 1985, section 15-4. Second order, reversible; |v| stays below c for any force. In a uniform E exact to
 * round-off. v near c has lost digits of gamma: 1e-16 gamma^2 of it. Cost: three square roots a particle. SPDX-License-Identifier: GPL-3.0-or-later */
#include "step-parts/magnetic-turn.h"
#include "step-parts/plain-pass.h"
#include "step/step.h"

static double square(const double x[3]) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2]; }

/* Half of the rotation of u, whose gamma it keeps. */
static void rotate(double dt, const struct pm_magnetic *m, size_t i, double u[3])
{
	const double gamma = sqrt(1 + square(u) / (m->c * m->c)), half = 0.5 * dt * m->charge[i] / (m->mass[i] * gamma);
	double t[3], tau[3];
	for (int c = 0; c < 3; c++)
		t[c] = half * m->b[c][i];
	for (int c = 0; c < 3; c++)
		tau[c] = t[c] / (1 + sqrt(1 + square(t)));
	pm_magnetic_turn(tau, u);
}

static void magnetic(bool closing, double dt, size_t from, size_t to, const struct pm_magnetic *m)
{
	for (size_t i = from; i < to; i++) {
		double u[3];
		for (int c = 0; c < 3; c++)
			u[c] = pm_magnetic_component((const double *const *)m->v, c, i);
		const double gamma = 1 / sqrt(1 - square(u) / (m->c * m->c));
		for (int c = 0; c < 3; c++)
			u[c] *= gamma;
		if (!closing && m->b[0])
			rotate(dt, m, i, u);
		for (int c = 0; c < 3; c++)
			u[c] += 0.5 * dt * pm_magnetic_component(m->acc, c, i);
		if (closing && m->b[0])
			rotate(dt, m, i, u);
		const double slower = 1 / sqrt(1 + square(u) / (m->c * m->c));
		for (int c = 0; c < 3; c++)
			if (m->v[c])
				m->v[c][i] = u[c] * slower;
	}
}

const struct pm_step step_relativistic = {
	.name = "relativistic",
	.sentence = "half a step of velocities whose inertia grows with the speed, by the constant c (relativistic/2)",
	.source = "Boris 1970",
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
