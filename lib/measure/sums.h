/* Compensated sums (Neumaier 1974) of eight numbers at a time: the rounding error of every addition by the six operations of Knuth's exact sum, which need no
 * comparison. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_SUMS_H
#define PM_MEASURE_SUMS_H

#include <string.h>

#include "base/base.h"
#include "base/lanes.h"

struct pm_sums {
	pm_lanes sum, carry;
};

PM_LANES_INLINE void pm_sums_add(struct pm_sums *s, pm_lanes x)
{
	pm_lanes t = s->sum + x, z = t - s->sum;
	s->carry += (s->sum - (t - z)) + (x - z);
	s->sum = t;
}

/* Lane after lane. */
static inline void pm_sums_join(struct pm_sum *all, const struct pm_sums *s)
{
	for (int l = 0; l < PM_VECTOR_LANES; l++) {
		pm_sum_add(all, s->sum[l]);
		pm_sum_add(all, s->carry[l]);
	}
}

/* Eight values from anywhere; the first n of them, then zeros. */
PM_LANES_INLINE pm_lanes pm_sums_load(const double *p)
{
	pm_lanes v;
	memcpy(&v, p, sizeof v);
	return v;
}
PM_LANES_INLINE pm_lanes pm_sums_load_few(const double *p, size_t n)
{
	pm_lanes v = {0};
	memcpy(&v, p, n * sizeof *p);
	return v;
}

#endif
