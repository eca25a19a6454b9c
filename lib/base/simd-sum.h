/* Compensated sums (Neumaier 1974) of eight numbers at a time: the rounding error of every addition by the six operations of Knuth's exact sum, which need no
 * comparison. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_BASE_SIMD_SUM_H
#define PM_BASE_SIMD_SUM_H

#include "base/base.h"
#include "base/simd.h"

struct pm_simd_sum {
	pm_simd sum, carry;
};

PM_SIMD_INLINE void pm_simd_sum_add(struct pm_simd_sum *s, pm_simd x)
{
	pm_simd t = s->sum + x, z = t - s->sum;
	s->carry += (s->sum - (t - z)) + (x - z);
	s->sum = t;
}

/* Lane after lane. */
static inline void pm_simd_sum_join(struct pm_sum *all, const struct pm_simd_sum *s)
{
	for (int l = 0; l < PM_SIMD_WIDTH; l++) {
		pm_sum_add(all, s->sum[l]);
		pm_sum_add(all, s->carry[l]);
	}
}

/* The first n of eight values, then zeros. */
PM_SIMD_INLINE pm_simd pm_simd_load_few(const double *p, size_t n)
{
	pm_simd v = {0};
	memcpy(&v, p, n * sizeof *p);
	return v;
}

#endif
