/* Half a step of Boris: half of the rotation and half of the kick; the opening half (before the drift) rotates, then kicks, the closing half kicks, then
 * rotates. The schemes differ in the angle. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STEP_PARTS_BORIS_HALF_H
#define PM_STEP_PARTS_BORIS_HALF_H

#include "step-parts/magnetic-turn.h"
#include "step/step.h"

/* tau, tan of half of the angle that this half turns, along B, from t = (q/m) B dt/2, whose square is t2. */
typedef void pm_boris_angle(const double t[3], double t2, double tau[3]);

static inline void pm_boris_half(bool closing, double dt, size_t from, size_t to, const struct pm_magnetic *m, pm_boris_angle *angle)
{
	for (size_t i = from; i < to; i++) {
		double v[3], a[3], t[3], tau[3], t2 = 0;
		const double half = 0.5 * dt * m->charge[i] / m->mass[i];
		for (int c = 0; c < 3; c++) {
			v[c] = pm_magnetic_component((const double *const *)m->v, c, i);
			a[c] = 0.5 * dt * pm_magnetic_component(m->acc, c, i);
			t[c] = half * pm_magnetic_component(m->b, c, i);
			t2 += t[c] * t[c];
			v[c] += closing ? a[c] : 0;
		}
		angle(t, t2, tau);
		pm_magnetic_turn(tau, v);
		for (int c = 0; c < 3; c++)
			if (m->v[c])
				m->v[c][i] = v[c] + (closing ? 0 : a[c]);
	}
}

#endif
