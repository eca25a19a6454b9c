/* What relativistic kicks share, of particle l of the lanes: u = gamma v where the frame keeps v, the kick by E, and the implicit half of a rotation about B.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STEP_PARTS_PROPER_VELOCITY_H
#define PM_STEP_PARTS_PROPER_VELOCITY_H

#include "step-parts/magnetic-lanes.h"

PM_SIMD_INLINE double pm_proper_dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

PM_SIMD_INLINE void pm_proper_load(const struct pm_magnetic_lanes *p, size_t l, double u[3])
{
	for (int c = 0; c < 3; c++)
		u[c] = p->v[c][l];
	const double gamma = 1 / sqrt(1 - pm_proper_dot(u, u) / (p->c * p->c));
	for (int c = 0; c < 3; c++)
		u[c] *= gamma;
}

PM_SIMD_INLINE double pm_proper_gamma(const struct pm_magnetic_lanes *p, const double u[3]) { return sqrt(1 + pm_proper_dot(u, u) / (p->c * p->c)); }

/* NaN where u^2 overflows: the quotient is 0, and the particle would be at rest. */
PM_SIMD_INLINE void pm_proper_store(const struct pm_magnetic_lanes *p, size_t l, const double u[3], double changed[3][PM_MAGNETIC_LANES])
{
	const double gamma = pm_proper_gamma(p, u), slower = 1 / gamma + (gamma - gamma);
	for (int c = 0; c < 3; c++)
		changed[c][l] = u[c] * slower;
}

/* u += q E dt/2m. */
PM_SIMD_INLINE void pm_proper_kick(const struct pm_magnetic_lanes *p, double dt, size_t l, double u[3])
{
	for (int c = 0; c < 3; c++)
		u[c] += 0.5 * dt * p->acc[c][l];
}

/* tau = q B dt/2m. */
PM_SIMD_INLINE void pm_proper_angle(const struct pm_magnetic_lanes *p, double dt, size_t l, double tau[3])
{
	for (int c = 0; c < 3; c++)
		tau[c] = 0.5 * dt * p->charge[l] / p->mass[l] * p->b[c][l];
}

/* u += u x tau/gamma, gamma that of u. */
PM_SIMD_INLINE void pm_proper_cross(const struct pm_magnetic_lanes *p, const double tau[3], double u[3])
{
	const double part = 1 / pm_proper_gamma(p, u), v[3] = {u[0], u[1], u[2]};
	for (int c = 0; c < 3; c++) {
		const int d = (c + 1) % 3, e = (c + 2) % 3;
		u[c] += part * (v[d] * tau[e] - v[e] * tau[d]);
	}
}

/* The w with w = u + w x tau/gamma, gamma that of w (Vay 2008, eqs. 11 and 12). */
PM_SIMD_INLINE void pm_proper_solve(const struct pm_magnetic_lanes *p, const double tau[3], double u[3])
{
	const double g = pm_proper_gamma(p, u), tau2 = pm_proper_dot(tau, tau), along = pm_proper_dot(u, tau) / p->c, sigma = g * g - tau2;
	const double gamma = sqrt(0.5 * (sigma + sqrt(sigma * sigma + 4 * (tau2 + along * along)))), t[3] = {tau[0] / gamma, tau[1] / gamma, tau[2] / gamma};
	const double s = 1 / (1 + tau2 / (gamma * gamma)), dot = pm_proper_dot(u, t), v[3] = {u[0], u[1], u[2]};
	for (int c = 0; c < 3; c++) {
		const int d = (c + 1) % 3, e = (c + 2) % 3;
		u[c] = s * (v[c] + dot * t[c] + (v[d] * t[e] - v[e] * t[d]));
	}
}

/* Half a step of Higuera and Cary 2017. */
PM_SIMD_INLINE void pm_proper_higuera_cary(const struct pm_magnetic_lanes *p, bool closing, double dt, size_t l, double u[3])
{
	double tau[3];
	pm_proper_angle(p, dt, l, tau);
	if (!closing)
		pm_proper_cross(p, tau, u);
	pm_proper_kick(p, dt, l, u);
	if (closing)
		pm_proper_solve(p, tau, u);
}

#endif
