/* A parallel region of one thread is a call. gcc's libgomp makes a team of one for it, and calls the system at its end to wake nobody: half of the
 * time of `plan -t 40` of ten bodies (4.5 to 2.3 s), whose loops are all too short for threads. The linker sends the regions here (--wrap in the
 * Makefile); those inside of another region go on to libgomp. What stands in a region (loops, barriers) does without a team what it does in a team of
 * one. SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>

typedef void region(void *data);
/* Weak: who links the static library without --wrap has no such function, and the one below is not called. */
void __real_GOMP_parallel(region *work, void *data, unsigned threads, unsigned flags) __attribute__((weak));
void __wrap_GOMP_parallel(region *work, void *data, unsigned threads, unsigned flags);

void __wrap_GOMP_parallel(region *work, void *data, unsigned threads, unsigned flags)
{
	if ((threads == 1 || (!threads && omp_get_max_threads() == 1)) && !omp_get_level())
		work(data);
	else
		__real_GOMP_parallel(work, data, threads, flags);
}
