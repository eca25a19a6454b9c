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

/* The same for a part of the lanes. */
PM_SIMD_INLINE void pm_simd_part_sum_add(pm_simd_part *sum, pm_simd_part *carry, pm_simd_part x)
{
	const pm_simd_part t = *sum + x, z = t - *sum;
	*carry += (*sum - (t - z)) + (x - z);
	*sum = t;
}

/* The lanes l and l + 4, then l and l + 2, then the last two; and their sum to the others. */
PM_SIMD_INLINE void pm_simd_sum_join(struct pm_sum *all, const struct pm_simd_sum *s)
{
	struct pm_simd_sum t = *s;
	t.carry += __builtin_shufflevector(t.carry, t.carry, 4, 5, 6, 7, 0, 1, 2, 3);
	pm_simd_sum_add(&t, __builtin_shufflevector(t.sum, t.sum, 4, 5, 6, 7, 0, 1, 2, 3));
	t.carry += __builtin_shufflevector(t.carry, t.carry, 2, 3, 0, 1, 6, 7, 4, 5);
	pm_simd_sum_add(&t, __builtin_shufflevector(t.sum, t.sum, 2, 3, 0, 1, 6, 7, 4, 5));
	t.carry += __builtin_shufflevector(t.carry, t.carry, 1, 0, 3, 2, 5, 4, 7, 6);
	pm_simd_sum_add(&t, __builtin_shufflevector(t.sum, t.sum, 1, 0, 3, 2, 5, 4, 7, 6));
	pm_sum_add(all, t.sum[0]);
	pm_sum_add(all, t.carry[0]);
}

/* The first n of eight values, then zeros. */
PM_SIMD_INLINE pm_simd pm_simd_load_few(const double *p, size_t n)
{
	pm_simd v = {0};
	memcpy(&v, p, n * sizeof *p);
	return v;
}

#endif
