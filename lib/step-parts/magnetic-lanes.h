/* The loop of magnetic kicks: components are short pieces of the arrays, or short arrays where there are none or too few, so that the compiler keeps a particle
 * in each lane of a register; the same bytes as one after the other. SPDX-License-Identifier: GPL-3.0-or-later */
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

/* n values from i on where they fill all lanes, else copied to few. */
PM_SIMD_INLINE const double *pm_magnetic_take(const double *from, size_t i, size_t n, double none, double few[PM_MAGNETIC_LANES])
{
	if (from && n == PM_MAGNETIC_LANES) {
		for (size_t l = 0; l < PM_MAGNETIC_LANES; l += 8) /* up to eleven arrays are more streams than the processor follows by itself */
			__builtin_prefetch(from + i + PM_MAGNETIC_LANES + l);
		return from + i;
	}
	for (size_t l = 0; l < PM_MAGNETIC_LANES; l++)
		few[l] = from && l < n ? from[i + l] : none;
	return few;
}

/* KICK(p) changes the velocity of struct pm_magnetic_one *p. */
#define PM_MAGNETIC_LOOP(m, from, to, KICK) \
	for (size_t at = (from); at < (to); at += PM_MAGNETIC_LANES) { \
		const size_t many = (to) - at < PM_MAGNETIC_LANES ? (to) - at : PM_MAGNETIC_LANES; \
		double few[11][PM_MAGNETIC_LANES], changed[3][PM_MAGNETIC_LANES]; \
		const double *v[3], *acc[3], *b[3]; \
		for (int c = 0; c < 3; c++) { \
			v[c] = pm_magnetic_take((m)->v[c], at, many, 0, few[c]); \
			acc[c] = pm_magnetic_take((m)->acc[c], at, many, 0, few[3 + c]); \
			b[c] = pm_magnetic_take((m)->b[c], at, many, 0, few[6 + c]); \
		} \
		const double *const charge = pm_magnetic_take((m)->charge, at, many, 1, few[9]); \
		const double *const mass = pm_magnetic_take((m)->mass, at, many, 1, few[10]); \
		for (size_t l = 0; l < PM_MAGNETIC_LANES; l++) { \
			struct pm_magnetic_one p = {{v[0][l], v[1][l], v[2][l]}, {acc[0][l], acc[1][l], acc[2][l]}, {b[0][l], b[1][l], b[2][l]}, \
				charge[l], mass[l]}; \
			KICK(&p); \
			changed[0][l] = p.v[0], changed[1][l] = p.v[1], changed[2][l] = p.v[2]; \
		} \
		for (int c = 0; c < 3; c++) \
			if ((m)->v[c]) \
				memcpy((m)->v[c] + at, changed[c], many * sizeof(double)); \
	}

#endif
