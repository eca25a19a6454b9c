/* Sums of an array by the law of sums (in-order.h): blocks of fixed size, added in order (Neumaier 1974); and whether all values are finite.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/in-order.h"

double pm_sum_array(size_t n, const double *x) { return pm_sum_products(n, x, NULL); }

double pm_sum_products(size_t n, const double *x, const double *y)
{
	struct pm_sum all = {0, 0};
	pm_sum_of_set(n, x, y, &all);
	return pm_sum_total(all);
}

bool pm_finite(size_t n, const double *x)
{
	int bad = 0;
#pragma omp parallel for schedule(static) reduction(| : bad) if (n > pm_many_turns())
	for (size_t b = 0; b < (n + pm_sum_block - 1) / pm_sum_block; b++) {
		size_t from = b * pm_sum_block;
		bad |= !pm_finite_few(n - from < pm_sum_block ? n - from : pm_sum_block, x + from);
	}
	return !bad;
}
