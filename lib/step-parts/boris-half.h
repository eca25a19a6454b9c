/* Half a step of Boris: half of the rotation and half of the kick; the opening half (before the drift) rotates, then kicks, the closing half kicks, then
 * rotates. The schemes differ in the angle. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STEP_PARTS_BORIS_HALF_H
#define PM_STEP_PARTS_BORIS_HALF_H

#include "step-parts/magnetic-lanes.h"

/* What t is to be multiplied by for tau, tan of half of the angle that this half turns, along B; t = (q/m) B dt/2, t2 its square. Of all lanes. */
typedef void pm_boris_angles(const double t2[PM_MAGNETIC_LANES], double part[PM_MAGNETIC_LANES]);

PM_SIMD_INLINE void pm_boris_half(bool closing, double dt, const struct pm_magnetic_lanes *p, pm_boris_angles *angles)
{
	double t[3][PM_MAGNETIC_LANES], t2[PM_MAGNETIC_LANES], part[PM_MAGNETIC_LANES];
	for (size_t l = 0; l < PM_MAGNETIC_LANES; l++) {
		const double half = 0.5 * dt * p->charge[l] / p->mass[l], x = half * p->b[0][l], y = half * p->b[1][l], z = half * p->b[2][l];
		t[0][l] = x, t[1][l] = y, t[2][l] = z;
		t2[l] = x * x + y * y + z * z;
	}
	angles(t2, part);
	for (size_t l = 0; l < PM_MAGNETIC_LANES; l++) {
		double v[3], a[3];
		PM_SIMD_UNROLL
		for (int c = 0; c < 3; c++) {
			a[c] = 0.5 * dt * p->acc[c][l];
			v[c] = p->v[c][l] + (closing ? a[c] : 0);
		}
		pm_magnetic_turn((const double[3]){t[0][l] * part[l], t[1][l] * part[l], t[2][l] * part[l]}, v);
		PM_SIMD_UNROLL
		for (int c = 0; c < 3; c++)
			p->changed[c][l] = v[c] + (closing ? 0 : a[c]);
	}
}

#endif
