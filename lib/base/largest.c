/* The largest absolute value of an array. Cost: a pass over it. SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/largest.h"

double pm_largest(size_t n, const double *x)
{
	enum { few = 1024 };
	int64_t most = 0;
#pragma omp parallel for schedule(static) reduction(max : most) if (n > pm_many_turns())
	for (size_t i = 0; i < n; i += few)
		pm_largest_few(n - i < few ? n - i : few, x + i, &most);
	return pm_of_bits(most);
}
