/* The largest absolute value of many, by the bits, which are ordered as the numbers are: a loop over whole numbers runs eight at a time.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_BASE_LARGEST_H
#define PM_BASE_LARGEST_H

#include <string.h>

#include "base/base.h"

double pm_largest(size_t n, const double *x); /* 0 of none */

/* Its parts, by the calling thread: raises *bits, 0 at first, to those of the largest of these. */
static inline void pm_largest_few(size_t n, const double *x, int64_t *bits)
{
	int64_t most = *bits;
	for (size_t i = 0; i < n; i++) {
		int64_t size;
		memcpy(&size, x + i, sizeof size);
		size &= INT64_MAX;
		most = size > most ? size : most;
	}
	*bits = most;
}

static inline double pm_of_bits(int64_t bits)
{
	double x;
	memcpy(&x, &bits, sizeof x);
	return x;
}

#endif
