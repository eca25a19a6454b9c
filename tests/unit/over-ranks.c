/* Parts over stretches on 1 to 7 rehearsed ranks: the bytes of a run alone, on every rank; a failure on one of them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "world/launch.h"
#include "world/over-ranks.h"
#include "check.h"

enum { MOST = 600 * pm_sum_block }; /* more than a lot of blocks on a rank */
static double x[MOST];
static const size_t sizes[] = {0, 1, 4096, 4097, 8191, 70000, MOST - 77};
static int kind; /* how the blocks are dealt */

static void make(const void *data, size_t from, size_t to, void *part)
{
	for (size_t i = from; i < to; i++)
		pm_sum_add(part, ((const double *)data)[i]);
}
static const struct pm_parts plain = {.size = sizeof(struct pm_sum), .make = make, .join = pm_join_sums};

/* Terms up to 1e34 that nearly cancel, the large ones in pairs: sums in different orders differ. */
static void fill(size_t n)
{
	static double large[5003];
	for (int i = 0; i < 5003; i++)
		large[i] = exp(78 * fmod(0.6180339887 * i, 1));
	for (size_t i = 0; i < n; i++)
		x[i] = i % 3 == 2 || i + 1 >= n - n % 3 ? 1 + (double)(i % 7) / 3 : large[i / 3 % 5003];
	for (size_t i = 1; i < n - n % 3; i += 3)
		x[i] = -x[n - n % 3 - 2 - i];
}

static struct pm_sum wanted(size_t n)
{
	struct pm_sum all = {0.1, 0}; /* joined to what was there */
	for (size_t from = 0; from < n; from += pm_sum_block) {
		struct pm_sum block = {0, 0};
		make(x, from, from + pm_sum_block < n ? from + pm_sum_block : n, &block);
		pm_sum_add(&all, block.sum), pm_sum_add(&all, block.carry);
	}
	return all;
}

/* The beginning of a rank's stretch: even, all on the last rank, or growing with the rank. */
static size_t beginning(size_t n, int rank, int size)
{
	const size_t blocks = (n + pm_sum_block - 1) / pm_sum_block, r = (size_t)rank, s = (size_t)size;
	const size_t at = pm_sum_block * (rank == size ? blocks : kind == 0 ? blocks * r / s : kind == 1 ? 0 : blocks * r * r / (s * s));
	return at < n ? at : n;
}

static bool good(void)
{
	const int me = pm_world_rank(), size = pm_world_size();
	bool same = true;
	for (int k = 0; k < 7; k++) {
		const size_t n = sizes[k];
		fill(n);
		const struct pm_sum want = wanted(n);
		struct pm_sum alone = {0, 0};
		pm_sum_of_set(n, x, x, &alone);
		for (kind = 0; kind < 3; kind++) {
			const size_t from = beginning(n, me, size), here = beginning(n, me + 1, size) - from;
			struct pm_sum got = {me ? 5 : 0.1, 0}, products = {0, 0};
			same &= !pm_world_over_set(0, &plain, x + from, here, &got) && !memcmp(&got, &want, sizeof got);
			same &= !pm_world_sum_of_set(0, here, x + from, x + from, &products) && !memcmp(&products, &alone, sizeof alone);
		}
	}
	struct pm_sum none = {0, 0};
	const int status = pm_world_over_set(me == size - 1 ? pm_fail(PM_NUMERICS, "the last rank failed") : 0, &plain, x, 4096, &none);
	return same && pm_exit_code(status) == PM_NUMERICS && !strcmp(pm_message(), "the last rank failed");
}

int main(void)
{
	for (int n = 1; n <= 7; n += n < 4 ? 1 : 3) {
		struct pm_transport t;
		int how;
		fflush(NULL);
		const pid_t pid = fork();
		if (!pid) {
			alarm(60);
			pm_threads_use(2);
			if (n > 1 && pm_transport_rehearse(&t, n))
				_exit(99);
			if (n > 1)
				pm_world_set(&t);
			int64_t bad = !good();
			const int status = pm_world_count(0, PM_SUM_OF, 1, &bad), rank = pm_world_rank(), end = pm_world_end();
			_exit(rank ? 0 : status || bad || end);
		}
		check(waitpid(pid, &how, 0) == pid && !how,
			"%d ranks: sum and carry of 0 to 2.5 million values, however they are dealt, and a failure of one rank", n);
	}
	fill(70000);
	const struct pm_sum law = wanted(70000);
	struct pm_sum running = {0.1, 0};
	make(x, 0, 70000, &running);
	check(pm_sum_total(law) != pm_sum_total(running), "one running sum gives other bytes: the numbers tell");
	return check_done();
}
