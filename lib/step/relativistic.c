/* Relativistic kick: (gamma v)' = acc + (q/m) v x B, gamma = 1/sqrt(1 - v^2/c^2), split like boris: half a step (relativistic/2) is half of the rotation,
 * by the frequency Omega/gamma, and half of the kick of u = gamma v; the opening half rotates, then kicks, the closing half kicks, then rotates.
 * Without a magnetic field only the kick. The frame keeps v; c is its constant.
 * Source: Boris 1970; Birdsall and Langdon 1985, section 15-4. Second order, reversible; |v| stays below c for any force. In a uniform E exact to
 * round-off. v near c has lost digits of gamma: 1e-16 gamma^2 of it. Cost: three roots and five quotients a particle.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step-parts/magnetic-lanes.h"
#include "step-parts/plain-pass.h"
#include "step/step.h"

PM_SIMD_INLINE double square(const double x[3]) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2]; }

/* Half of the rotation of u, whose gamma it keeps. slower: 1/gamma. */
PM_SIMD_INLINE void rotate(double dt, double slower, const struct pm_magnetic_one *p, double u[3])
{
	const double half = 0.5 * dt * p->charge / p->mass * slower;
	const double t[3] = {half * p->b[0], half * p->b[1], half * p->b[2]}, part = 1 / (1 + sqrt(1 + square(t)));
	const double tau[3] = {t[0] * part, t[1] * part, t[2] * part};
	pm_magnetic_turn(tau, u);
}

PM_SIMD_INLINE void kick(bool opens, bool closes, double dt, double light, struct pm_magnetic_one *p)
{
	const double per = 1 / (light * light), before = sqrt(1 - square(p->v) * per), gamma = 1 / before;
	double u[3] = {p->v[0] * gamma, p->v[1] * gamma, p->v[2] * gamma};
	if (opens)
		rotate(dt, before, p, u);
	PM_SIMD_UNROLL
	for (int c = 0; c < 3; c++)
		u[c] += 0.5 * dt * p->acc[c];
	const double slower = 1 / sqrt(1 + square(u) * per);
	if (closes)
		rotate(dt, slower, p, u);
	PM_SIMD_UNROLL
	for (int c = 0; c < 3; c++)
		p->v[c] = u[c] * slower;
}

static void magnetic(bool closing, double dt, size_t from, size_t to, const struct pm_magnetic *m)
{
	const double light = m->c;
#define STRAIGHT(p) kick(false, false, dt, light, p)
#define OPENING(p) kick(true, false, dt, light, p)
#define CLOSING(p) kick(false, true, dt, light, p)
	if (!m->b[0])
		PM_MAGNETIC_LOOP(m, from, to, STRAIGHT)
	else if (closing)
		PM_MAGNETIC_LOOP(m, from, to, CLOSING)
	else
		PM_MAGNETIC_LOOP(m, from, to, OPENING)
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
