/* Relativistic kick: (gamma v)' = acc + (q/m) v x B, gamma = 1/sqrt(1 - v^2/c^2), split like boris: half a step (relativistic/2) is half of the rotation,
 * by the frequency Omega/gamma, and half of the kick of u = gamma v; the opening half rotates, then kicks, the closing half kicks, then rotates.
 * Without a magnetic field only the kick. The frame keeps v; c is its constant.
 * Source: Boris 1970; Birdsall and Langdon 1985, section 15-4. Second order, reversible; |v| stays below c for any force. In a uniform E exact to
 * round-off. v near c has lost digits of gamma: 1e-16 gamma^2 of it. Cost: three roots and four quotients a particle,
 * and one where charges or masses differ.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step-parts/magnetic-lanes.h"
#include "step-parts/plain-pass.h"
#include "step/step.h"

enum { lanes_of = PM_MAGNETIC_LANES };

PM_SIMD_INLINE double square(const double x[3]) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2]; }

/* The tangent tau of half of the rotation of u, whose gamma it keeps. half: q dt/2m gamma. */
PM_SIMD_INLINE void find_tangent(double half, const struct pm_magnetic_lanes *p, size_t l, double tau[3][lanes_of])
{
	const double t[3] = {half * p->b[0][l], half * p->b[1][l], half * p->b[2][l]}, part = 1 / (1 + sqrt(1 + square(t)));
	tau[0][l] = t[0] * part, tau[1][l] = t[1] * part, tau[2][l] = t[2] * part;
}

PM_SIMD_INLINE void add_acceleration(double dt, const struct pm_magnetic_lanes *p, size_t l, double u[3])
{
	PM_SIMD_UNROLL
	for (int c = 0; c < 3; c++)
		u[c] += 0.5 * dt * p->acc[c][l];
}

/* In loops that are short enough for the next particles to begin while those under way wait for their roots and quotients, and that share these evenly. */
PM_SIMD_INLINE void kick(bool opens, bool closes, double dt, double light, const struct pm_magnetic_lanes *p)
{
	const double per = 1 / (light * light), one = opens || closes ? 0.5 * dt * p->charge[0] / p->mass[0] : 0;
	double rate[lanes_of], slower[lanes_of], u[3][lanes_of], tau[3][lanes_of];
	for (size_t l = 0; l < lanes_of && (opens || closes); l++)
		rate[l] = one;
	for (size_t l = 0; l < lanes_of && (opens || closes) && !p->alike; l++)
		rate[l] = 0.5 * dt * p->charge[l] / p->mass[l];
	for (size_t l = 0; l < lanes_of; l++) {
		double w[3] = {p->v[0][l], p->v[1][l], p->v[2][l]};
		const double less = sqrt(1 - square(w) * per), gamma = 1 / less;
		PM_SIMD_UNROLL
		for (int c = 0; c < 3; c++)
			w[c] *= gamma;
		if (opens)
			find_tangent(rate[l] * less, p, l, tau);
		else {
			add_acceleration(dt, p, l, w);
			slower[l] = 1 / sqrt(1 + square(w) * per);
		}
		PM_SIMD_UNROLL
		for (int c = 0; c < 3; c++)
			u[c][l] = w[c];
	}
	for (size_t l = 0; l < lanes_of && closes; l++)
		find_tangent(rate[l] * slower[l], p, l, tau);
	for (size_t l = 0; l < lanes_of; l++) {
		double w[3] = {u[0][l], u[1][l], u[2][l]};
		if (opens || closes)
			pm_magnetic_turn((const double[3]){tau[0][l], tau[1][l], tau[2][l]}, w);
		if (opens)
			add_acceleration(dt, p, l, w);
		const double less = opens ? 1 / sqrt(1 + square(w) * per) : slower[l];
		PM_SIMD_UNROLL
		for (int c = 0; c < 3; c++)
			p->changed[c][l] = w[c] * less;
	}
}

static void magnetic(bool closing, double dt, size_t from, size_t to, const struct pm_magnetic *m)
{
	const double light = m->c;
	if (!m->b[0])
		PM_MAGNETIC_LOOP(m, from, to, kick, false, false, dt, light)
	else if (closing)
		PM_MAGNETIC_LOOP(m, from, to, kick, false, true, dt, light)
	else
		PM_MAGNETIC_LOOP(m, from, to, kick, true, false, dt, light)
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
