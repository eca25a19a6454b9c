/* What the magnetic kicks share: a velocity turned by an angle. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STEP_PARTS_MAGNETIC_TURN_H
#define PM_STEP_PARTS_MAGNETIC_TURN_H

#include "base/base.h"
#include "base/simd.h"

/* v + (v + v x tau) x s with s = 2 tau/(1 + tau^2) turns by 2 atan |tau|. Rounding s would change |v| by a few 1e-17 with the same sign in every
 * step; the low part of 2/(1 + tau^2) corrects that, so that only random rounding remains. */
PM_SIMD_INLINE void pm_magnetic_turn(const double tau[3], double v[3])
{
	double high = 1, low = 0;
	PM_SIMD_UNROLL
	for (int c = 0; c < 3; c++) { /* 1 + tau^2 in two parts */
		const double square = tau[c] * tau[c], sum = high + square, part = sum - high;
		low += fma(tau[c], tau[c], -square) + ((high - (sum - part)) + (square - part));
		high = sum;
	}
	const double s = 2 / high, s_low = (fma(-s, high, 2) - s * low) * (0.5 * s);
	const double w[3] = {v[0] + (v[1] * tau[2] - v[2] * tau[1]), v[1] + (v[2] * tau[0] - v[0] * tau[2]), v[2] + (v[0] * tau[1] - v[1] * tau[0])};
	PM_SIMD_UNROLL
	for (int c = 0; c < 3; c++) {
		const int d = (c + 1) % 3, e = (c + 2) % 3;
		const double cross = w[d] * tau[e] - w[e] * tau[d];
		v[c] += fma(s, cross, s_low * cross);
	}
}

#endif
