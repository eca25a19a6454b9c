/* Half a step of Boris: half of the rotation and half of the kick; the opening half (before the drift) rotates, then kicks, the closing half kicks, then
 * rotates. The schemes differ in the angle. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STEP_PARTS_BORIS_HALF_H
#define PM_STEP_PARTS_BORIS_HALF_H

#include "step-parts/magnetic-lanes.h"

/* What t is to be multiplied by for tau, tan of half of the angle that this half turns, along B, and 2/(1 + tau^2); t = (q/m) B dt/2, t2 its square. */
typedef void pm_boris_angles(pm_simd t2, pm_simd *part, pm_simd *turn);

PM_SIMD_INLINE void pm_boris_half(bool closing, double dt, const struct pm_magnetic_lanes *p, pm_boris_angles *angles)
{
	_Alignas(64) double tau[3][PM_MAGNETIC_LANES], turn[PM_MAGNETIC_LANES];
	for (size_t l = 0; l < PM_MAGNETIC_LANES; l += PM_SIMD_WIDTH) {
		const pm_simd half = 0.5 * dt * pm_simd_load_any(p->charge + l) / pm_simd_load_any(p->mass + l);
		pm_simd t[3], part, near;
		PM_SIMD_UNROLL
		for (int c = 0; c < 3; c++)
			t[c] = half * pm_simd_load_any(p->b[c] + l);
		angles(pm_magnetic_square(t), &part, &near);
		PM_SIMD_UNROLL
		for (int c = 0; c < 3; c++)
			pm_simd_store_any(tau[c] + l, t[c] * part);
		pm_simd_store_any(turn + l, near);
	}
	for (size_t l = 0; l < PM_MAGNETIC_LANES; l += PM_SIMD_WIDTH) {
		pm_simd t[3], v[3], a[3];
		PM_SIMD_UNROLL
		for (int c = 0; c < 3; c++) {
			t[c] = pm_simd_load_any(tau[c] + l);
			a[c] = 0.5 * dt * pm_simd_load_any(p->acc[c] + l);
			v[c] = pm_simd_load_any(p->v[c] + l);
			v[c] = closing ? v[c] + a[c] : v[c];
		}
		pm_magnetic_turn(t, pm_simd_load_any(turn + l), v);
		PM_SIMD_UNROLL
		for (int c = 0; c < 3; c++)
			pm_simd_store_any(p->to[c] + l, closing ? v[c] : v[c] + a[c]);
	}
}

#endif
