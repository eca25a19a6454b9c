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

size_t pm_many_turns(void)
{
	static size_t turns;
	const char *said = turns ? NULL : getenv("PM_MANY_TURNS");
	if (!turns)
		turns = said && atoi(said) > 0 ? (size_t)atoi(said) : 1 << 17;
	return turns;
}

static double seconds_of(clockid_t clock)
{
	struct timespec t;
	clock_gettime(clock, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double pm_seconds(void) { return seconds_of(CLOCK_MONOTONIC); }

struct pm_clock pm_clock(void) { return (struct pm_clock){.wall = pm_seconds(), .processor = seconds_of(CLOCK_PROCESS_CPUTIME_ID)}; }
