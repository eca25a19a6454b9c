/* The loop of magnetic kicks: components are short pieces of the arrays, or short arrays where there are none or too few, so that the compiler keeps a particle
 * in each lane of a register; the same bytes as one after the other. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STEP_PARTS_MAGNETIC_LANES_H
#define PM_STEP_PARTS_MAGNETIC_LANES_H

#define PM_SIMD_NARROW

#include <string.h>

#include "base/simd.h"
#include "step-parts/magnetic-turn.h"
#include "step/step.h"

enum { PM_MAGNETIC_LANES = 64 };

/* n values from i on where they fill all lanes, else copied to few. far: many more follow, hardly in a cache. */
PM_SIMD_INLINE const double *pm_magnetic_take(const double *from, size_t i, size_t n, bool far, double none, double few[PM_MAGNETIC_LANES])
{
	if (from && n == PM_MAGNETIC_LANES) {
		for (size_t l = 0; l < PM_MAGNETIC_LANES && far; l += 8) /* up to eleven arrays are more streams than the processor follows by itself */
			__builtin_prefetch(from + i + PM_MAGNETIC_LANES + l);
		return from + i;
	}
	for (size_t l = 0; l < PM_MAGNETIC_LANES; l++)
		few[l] = none;
	if (from) /* not in one loop: masked loads from no array, as gcc makes them, take hundreds of cycles each, though no lane is read */
		memcpy(few, from + i, n * sizeof *few);
	return few;
}

/* The pieces of the arrays for so many particles, and where their new velocities go: as a rule to v itself, so that a kick reads a lane before it writes it. */
struct pm_magnetic_lanes {
	const double *v[3], *acc[3], *b[3], *charge, *mass;
	double *to[3];
	bool alike;
	double c, radiation_time; /* of struct pm_magnetic */
};

/* What a loop over single particles has found: the compiler makes vectors of it only where it stores to an array that is nobody else's. */
PM_SIMD_INLINE void pm_magnetic_put(const struct pm_magnetic_lanes *p, double changed[3][PM_MAGNETIC_LANES])
{
	for (int c = 0; c < 3; c++)
		memcpy(p->to[c], changed[c], PM_MAGNETIC_LANES * sizeof(double));
}

/* kick(..., lanes) finds the velocities lanes->to of all lanes of struct pm_magnetic_lanes *lanes; an inline function, whose other arguments are constants. */
#define PM_MAGNETIC_LOOP(m, from, to, kick, ...) \
	for (size_t at = (from); at < (to); at += PM_MAGNETIC_LANES) { \
		const bool far = (to) - at > 16 * PM_MAGNETIC_LANES; \
		const size_t many = (to) - at < PM_MAGNETIC_LANES ? (to) - at : PM_MAGNETIC_LANES; \
		_Alignas(64) double few[11][PM_MAGNETIC_LANES], changed[3][PM_MAGNETIC_LANES]; \
		struct pm_magnetic_lanes lanes = {.alike = (m)->alike, .c = (m)->c, .radiation_time = (m)->radiation_time}; \
		for (int c = 0; c < 3; c++) { \
			lanes.to[c] = (m)->v[c] && many == PM_MAGNETIC_LANES ? (m)->v[c] + at : changed[c]; \
			lanes.v[c] = pm_magnetic_take((m)->v[c], at, many, far, 0, few[c]); \
			lanes.acc[c] = pm_magnetic_take((m)->acc[c], at, many, far, 0, few[3 + c]); \
			lanes.b[c] = pm_magnetic_take((m)->b[c], at, many, far, 0, few[6 + c]); \
		} \
		lanes.charge = pm_magnetic_take((m)->charge, at, many, far, 1, few[9]); \
		lanes.mass = pm_magnetic_take((m)->mass, at, many, far, 1, few[10]); \
		kick(__VA_ARGS__, &lanes); \
		for (int c = 0; c < 3; c++) \
			if ((m)->v[c] && many != PM_MAGNETIC_LANES) \
				memcpy((m)->v[c] + at, changed[c], many * sizeof(double)); \
	}

/* Both halves of kick(closing, dt, lanes), a loop for each. */
#define PM_MAGNETIC_HALVES(m, from, to, kick, closing, dt) \
	if (closing) \
		PM_MAGNETIC_LOOP(m, from, to, kick, true, dt) \
	else \
		PM_MAGNETIC_LOOP(m, from, to, kick, false, dt)

#endif
