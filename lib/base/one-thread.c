/* A parallel region of one thread is a call. gcc's libgomp makes a team of one for it, and wakes nobody by a call of the system at its end: half of the
 * time of a step of ten bodies, whose loops are all too short for threads. The linker sends the regions here (--wrap in the Makefile); those inside of
 * another region go on to libgomp. What stands in a region (loops, barriers) does without a team what it does in a team of one.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>

typedef void region(void *data);
void __real_GOMP_parallel(region *work, void *data, unsigned threads, unsigned flags);
void __wrap_GOMP_parallel(region *work, void *data, unsigned threads, unsigned flags);

void __wrap_GOMP_parallel(region *work, void *data, unsigned threads, unsigned flags)
{
	if ((threads == 1 || (!threads && omp_get_max_threads() == 1)) && !omp_get_level())
		work(data);
	else
		__real_GOMP_parallel(work, data, threads, flags);
}
