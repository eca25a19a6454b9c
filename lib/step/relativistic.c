/* Relativistic kick: (gamma v)' = acc + (q/m) v x B, gamma = 1/sqrt(1 - v^2/c^2), split like boris: half a step (relativistic/2) is half of the rotation,
 * by the frequency Omega/gamma, and half of the kick of u = gamma v; the opening half rotates, then kicks, the closing half kicks, then rotates.
 * Without a magnetic field only the kick. The frame keeps v; c is its constant.
 * Source: Boris 1970; Birdsall and Langdon 1985, section 15-4. Second order, reversible; |v| stays below c for any force. In a uniform E exact to
 * round-off. v near c has lost digits of gamma: 1e-16 gamma^2 of it. Cost: three inverse roots and a quotient a particle,
 * and one more where charges or masses differ.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step-parts/magnetic-lanes.h"
#include "step-parts/plain-pass.h"
#include "step/step.h"

enum { lanes_of = PM_MAGNETIC_LANES };

PM_SIMD_INLINE void take(const double *const from[3], size_t l, pm_simd to[3])
{
	PM_SIMD_UNROLL
	for (int c = 0; c < 3; c++)
		to[c] = pm_simd_load_any(from[c] + l);
}

PM_SIMD_INLINE void put(const pm_simd x[3], double *const to[3], size_t l)
{
	PM_SIMD_UNROLL
	for (int c = 0; c < 3; c++)
		pm_simd_store_any(to[c] + l, x[c]);
}

PM_SIMD_INLINE void scale(pm_simd by, pm_simd x[3])
{
	PM_SIMD_UNROLL
	for (int c = 0; c < 3; c++)
		x[c] *= by;
}

PM_SIMD_INLINE void add_acceleration(double dt, const struct pm_magnetic_lanes *p, size_t l, pm_simd u[3])
{
	PM_SIMD_UNROLL
	for (int c = 0; c < 3; c++)
		u[c] = pm_simd_fma(pm_simd_all(0.5 * dt), pm_simd_load_any(p->acc[c] + l), u[c]);
}

/* 1/gamma of u = gamma v. Where v is c to round-off it is rounded as roots and quotients are, so that one component is never above c. NaN where u^2 overflows,
 * which would be at rest. */
PM_SIMD_INLINE pm_simd slower_of(const pm_simd u[3], double per)
{
	const pm_simd gamma2 = pm_simd_fma(pm_magnetic_square(u), pm_simd_all(per), pm_simd_all(1)), light = pm_simd_all(0x1p50);
	const pm_simd slower = pm_simd_rsqrt_near(gamma2);
	return pm_simd_any_below(light, gamma2) ? pm_simd_where_below(light, gamma2, 1 / pm_simd_sqrt(gamma2) + (gamma2 - gamma2), slower) : slower;
}

/* In loops that are short enough for the next particles to begin while those under way wait for their roots and quotients. */
PM_SIMD_INLINE void kick(bool opens, bool closes, double dt, double light, const struct pm_magnetic_lanes *p)
{
	const double per = 1 / (light * light), one = opens || closes ? 0.5 * dt * p->charge[0] / p->mass[0] : 0;
	_Alignas(64) double less[lanes_of], turn[lanes_of], u[3][lanes_of], tau[3][lanes_of];
	double *const to_u[3] = {u[0], u[1], u[2]}, *const to_tau[3] = {tau[0], tau[1], tau[2]};
	const double *const us[3] = {u[0], u[1], u[2]}, *const taus[3] = {tau[0], tau[1], tau[2]};
	pm_simd w[3], t[3];
	for (size_t l = 0; l < lanes_of; l += PM_SIMD_WIDTH) {
		take(p->v, l, w);
		const pm_simd less2 = pm_simd_fnma(pm_magnetic_square(w), pm_simd_all(per), pm_simd_all(1)), gamma = pm_simd_rsqrt(less2);
		scale(gamma, w);
		put(w, to_u, l);
		pm_simd_store_any(less + l, less2 * gamma);
	}
	for (size_t l = 0; l < lanes_of && closes; l += PM_SIMD_WIDTH) {
		take(us, l, w);
		add_acceleration(dt, p, l, w);
		pm_simd_store_any(less + l, slower_of(w, per));
		put(w, to_u, l);
	}
	for (size_t l = 0; l < lanes_of && (opens || closes); l += PM_SIMD_WIDTH) {
		const pm_simd rate = p->alike ? pm_simd_all(one) : 0.5 * dt * pm_simd_load_any(p->charge + l) / pm_simd_load_any(p->mass + l);
		take(p->b, l, t);
		scale(rate * pm_simd_load_any(less + l), t);
		const pm_simd length2 = 1 + pm_magnetic_square(t), slower = pm_simd_rsqrt(length2);
		scale(1 / pm_simd_fma(length2, slower, pm_simd_all(1)), t);
		put(t, to_tau, l);
		pm_simd_store_any(turn + l, 1 + slower);
	}
	for (size_t l = 0; l < lanes_of; l += PM_SIMD_WIDTH) {
		take(us, l, w);
		if (opens || closes) {
			take(taus, l, t);
			pm_magnetic_turn(t, pm_simd_load_any(turn + l), w);
		}
		if (closes)
			scale(pm_simd_load_any(less + l), w);
		else
			add_acceleration(dt, p, l, w);
		put(w, closes ? p->to : to_u, l);
	}
	for (size_t l = 0; l < lanes_of && !closes; l += PM_SIMD_WIDTH) {
		take(us, l, w);
		scale(slower_of(w, per), w);
		put(w, p->to, l);
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
