/* The loop of magnetic kicks: particles are copied into short arrays that all components have, so that the compiler keeps one in each lane of a register;
 * the same bytes as one after the other. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STEP_PARTS_MAGNETIC_LANES_H
#define PM_STEP_PARTS_MAGNETIC_LANES_H

#include <string.h>

#include "base/simd.h"
#include "step-parts/magnetic-turn.h"
#include "step/step.h"

enum { PM_MAGNETIC_LANES = 64 };

/* One particle; a component that the frame has not is 0. */
struct pm_magnetic_one {
	double v[3], acc[3], b[3], charge, mass;
};

PM_SIMD_INLINE void pm_magnetic_take(double *to, const double *from, size_t i, size_t n, double none)
{
	if (from && n == PM_MAGNETIC_LANES) {
		for (size_t l = 0; l < PM_MAGNETIC_LANES; l += 8) /* up to eleven arrays are more streams than the processor follows by itself */
			__builtin_prefetch(from + i + PM_MAGNETIC_LANES + l);
		memcpy(to, from + i, PM_MAGNETIC_LANES * sizeof *to);
	} else
		for (size_t l = 0; l < PM_MAGNETIC_LANES; l++)
			to[l] = from && l < n ? from[i + l] : none;
}

/* KICK(p) changes the velocity of struct pm_magnetic_one *p. */
#define PM_MAGNETIC_LOOP(m, from, to, KICK) \
	for (size_t at = (from); at < (to); at += PM_MAGNETIC_LANES) { \
		const size_t many = (to) - at < PM_MAGNETIC_LANES ? (to) - at : PM_MAGNETIC_LANES; \
		double v[3][PM_MAGNETIC_LANES], acc[3][PM_MAGNETIC_LANES], b[3][PM_MAGNETIC_LANES], charge[PM_MAGNETIC_LANES], mass[PM_MAGNETIC_LANES]; \
		for (int c = 0; c < 3; c++) { \
			pm_magnetic_take(v[c], (m)->v[c], at, many, 0); \
			pm_magnetic_take(acc[c], (m)->acc[c], at, many, 0); \
			pm_magnetic_take(b[c], (m)->b[c], at, many, 0); \
		} \
		pm_magnetic_take(charge, (m)->charge, at, many, 1); \
		pm_magnetic_take(mass, (m)->mass, at, many, 1); \
		for (size_t l = 0; l < PM_MAGNETIC_LANES; l++) { \
			struct pm_magnetic_one p = {{v[0][l], v[1][l], v[2][l]}, {acc[0][l], acc[1][l], acc[2][l]}, {b[0][l], b[1][l], b[2][l]}, \
				charge[l], mass[l]}; \
			KICK(&p); \
			v[0][l] = p.v[0], v[1][l] = p.v[1], v[2][l] = p.v[2]; \
		} \
		for (int c = 0; c < 3; c++) \
			if ((m)->v[c]) \
				memcpy((m)->v[c] + at, v[c], many * sizeof(double)); \
	}

#endif
