/* Sums that do not depend on the number of threads: compensated within blocks of fixed size, the blocks added in order (Neumaier 1974).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/base.h"

static struct pm_sum block_sum(size_t n, const double *x, const double *y)
{
	struct pm_sum s = {0};
	for (size_t i = 0; i < n; i++)
		pm_sum_add(&s, y ? x[i] * y[i] : x[i]);
	return s;
}

/* Chunks of blocks go to the threads; within a chunk and over the chunks the order is that of the array. */
static double sum(size_t n, const double *x, const double *y)
{
	enum { chunk = 256 };
	struct pm_sum total = {0}, part[chunk];
	size_t blocks = (n + pm_sum_block - 1) / pm_sum_block;
	for (size_t first = 0; first < blocks; first += chunk) {
		int m = (int)(blocks - first < chunk ? blocks - first : chunk);
#pragma omp parallel for schedule(static) if (m > 4)
		for (int b = 0; b < m; b++) {
			size_t i = (first + (size_t)b) * pm_sum_block, k = n - i < pm_sum_block ? n - i : pm_sum_block;
			part[b] = block_sum(k, x + i, y ? y + i : NULL);
		}
		for (int b = 0; b < m; b++) {
			pm_sum_add(&total, part[b].sum);
			pm_sum_add(&total, part[b].carry);
		}
	}
	return pm_sum_total(total);
}

double pm_sum_array(size_t n, const double *x) { return sum(n, x, NULL); }

double pm_sum_products(size_t n, const double *x, const double *y) { return sum(n, x, y); }

bool pm_finite(size_t n, const double *x)
{
	int bad = 0;
#pragma omp parallel for schedule(static) reduction(| : bad) if (n > 65536)
	for (size_t b = 0; b < (n + pm_sum_block - 1) / pm_sum_block; b++) {
		size_t from = b * pm_sum_block;
		bad |= !pm_finite_few(n - from < pm_sum_block ? n - from : pm_sum_block, x + from);
	}
	return !bad;
}
