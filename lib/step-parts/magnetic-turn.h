/* What the magnetic kicks share: a velocity turned by an angle. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STEP_PARTS_MAGNETIC_TURN_H
#define PM_STEP_PARTS_MAGNETIC_TURN_H

#include "base/base.h"
#include "base/simd.h"

/* v + (v + v x tau) x s with s = 2 tau/(1 + tau^2) turns by 2 atan |tau|. Rounding s would change |v| by a few 1e-17 with the same sign in every
 * step; the low part of 2/(1 + tau^2) corrects that, so that only random rounding remains. s: 2/(1 + tau^2) to some round-offs. */
PM_SIMD_INLINE void pm_magnetic_turn(const pm_simd tau[3], pm_simd s, pm_simd v[3])
{
	pm_simd high = pm_simd_all(1), low = pm_simd_all(0), w[3];
	PM_SIMD_UNROLL
	for (int c = 0; c < 3; c++) { /* 1 + tau^2 in two parts; exactly so while tau^2 is below 1 */
		const pm_simd sum = pm_simd_fma_once(tau[c], tau[c], high);
		low += pm_simd_fma_once(tau[c], tau[c], high - sum);
		high = sum;
	}
	const pm_simd s_low = pm_simd_fnma(s, low, pm_simd_fma_once(-s, high, pm_simd_all(2))) * (0.5 * s);
	PM_SIMD_UNROLL
	for (int c = 0; c < 3; c++) {
		const int d = (c + 1) % 3, e = (c + 2) % 3;
		w[c] = pm_simd_fma(v[d], tau[e], pm_simd_fnma(v[e], tau[d], v[c]));
	}
	PM_SIMD_UNROLL
	for (int c = 0; c < 3; c++) {
		const int d = (c + 1) % 3, e = (c + 2) % 3;
		const pm_simd cross = pm_simd_fma(w[d], tau[e], -(w[e] * tau[d]));
		v[c] += pm_simd_fma(s, cross, s_low * cross);
	}
}

/* Of a vector in the lanes, its square. */
PM_SIMD_INLINE pm_simd pm_magnetic_square(const pm_simd x[3]) { return pm_simd_fma(x[2], x[2], pm_simd_fma(x[1], x[1], x[0] * x[0])); }

#endif
