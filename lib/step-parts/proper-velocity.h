/* What relativistic kicks share: u = gamma v of a particle whose frame keeps v, the kick by E, and the implicit half of a rotation about B.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STEP_PARTS_PROPER_VELOCITY_H
#define PM_STEP_PARTS_PROPER_VELOCITY_H

#include "step-parts/magnetic-turn.h"
#include "step/step.h"

static inline double pm_proper_dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static inline void pm_proper_load(const struct pm_magnetic *m, size_t i, double u[3])
{
	for (int c = 0; c < 3; c++)
		u[c] = pm_magnetic_component((const double *const *)m->v, c, i);
	const double gamma = 1 / sqrt(1 - pm_proper_dot(u, u) / (m->c * m->c));
	for (int c = 0; c < 3; c++)
		u[c] *= gamma;
}

static inline double pm_proper_gamma(const struct pm_magnetic *m, const double u[3]) { return sqrt(1 + pm_proper_dot(u, u) / (m->c * m->c)); }

static inline void pm_proper_store(const struct pm_magnetic *m, size_t i, const double u[3])
{
	const double slower = 1 / pm_proper_gamma(m, u);
	for (int c = 0; c < 3; c++)
		if (m->v[c])
			m->v[c][i] = u[c] * slower;
}

/* u += q E dt/2m. */
static inline void pm_proper_kick(const struct pm_magnetic *m, double dt, size_t i, double u[3])
{
	for (int c = 0; c < 3; c++)
		u[c] += 0.5 * dt * pm_magnetic_component(m->acc, c, i);
}

/* tau = q B dt/2m. */
static inline void pm_proper_angle(const struct pm_magnetic *m, double dt, size_t i, double tau[3])
{
	for (int c = 0; c < 3; c++)
		tau[c] = m->b[0] ? 0.5 * dt * m->charge[i] / m->mass[i] * m->b[c][i] : 0;
}

/* u += u x tau/gamma, gamma that of u. */
static inline void pm_proper_cross(const struct pm_magnetic *m, const double tau[3], double u[3])
{
	const double part = 1 / pm_proper_gamma(m, u), v[3] = {u[0], u[1], u[2]};
	for (int c = 0; c < 3; c++) {
		const int d = (c + 1) % 3, e = (c + 2) % 3;
		u[c] += part * (v[d] * tau[e] - v[e] * tau[d]);
	}
}

/* The w with w = u + w x tau/gamma, gamma that of w (Vay 2008, eqs. 11 and 12). */
static inline void pm_proper_solve(const struct pm_magnetic *m, const double tau[3], double u[3])
{
	const double g = pm_proper_gamma(m, u), tau2 = pm_proper_dot(tau, tau), along = pm_proper_dot(u, tau) / m->c, sigma = g * g - tau2;
	const double gamma = sqrt(0.5 * (sigma + sqrt(sigma * sigma + 4 * (tau2 + along * along)))), t[3] = {tau[0] / gamma, tau[1] / gamma, tau[2] / gamma};
	const double s = 1 / (1 + tau2 / (gamma * gamma)), dot = pm_proper_dot(u, t), v[3] = {u[0], u[1], u[2]};
	for (int c = 0; c < 3; c++) {
		const int d = (c + 1) % 3, e = (c + 2) % 3;
		u[c] = s * (v[c] + dot * t[c] + (v[d] * t[e] - v[e] * t[d]));
	}
}

/* Half a step of Higuera and Cary 2017. */
static inline void pm_proper_higuera_cary(const struct pm_magnetic *m, bool closing, double dt, size_t i, double u[3])
{
	double tau[3];
	pm_proper_angle(m, dt, i, tau);
	if (!closing)
		pm_proper_cross(m, tau, u);
	pm_proper_kick(m, dt, i, u);
	if (closing)
		pm_proper_solve(m, tau, u);
}

#endif
