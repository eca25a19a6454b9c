/* Threads and the clock. The number of threads never changes a result. SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <stdlib.h>
#include <time.h>

#include "base/base.h"

int pm_threads(void) { return omp_get_max_threads(); }

void pm_threads_use(int n)
{
	if (n > 0)
		omp_set_num_threads(n);
}

double pm_seconds(void)
{
	struct timespec t;
	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}
