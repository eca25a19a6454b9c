/* What the machine can do, on one thread and on all: bandwidth of plain loops over 64 MiB arrays, and fused multiply-adds per second as the compiler
 * makes them (two operations each). The limits of all other rows. SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/simd.h"

#include "bandwidth.h"

enum { ELEMENTS = 8 << 20, TURNS = 1 << 22 };
#ifdef __AVX512F__
enum { CHAINS = 8 };
#else
enum { CHAINS = 4 }; /* of eight numbers each: as many as fit into sixteen registers */
#endif

/* Independent chains, enough to hide the latency. */
static double chains(double x)
{
	pm_simd s[CHAINS], a = pm_simd_all(1 - 1e-9 * x), b = pm_simd_all(1e-9);
	PM_SIMD_UNROLL
	for (int k = 0; k < CHAINS; k++)
		s[k] = pm_simd_all(x + k);
	for (int i = 0; i < TURNS; i++)
		PM_SIMD_UNROLL
		for (int k = 0; k < CHAINS; k++)
			s[k] = pm_simd_fma(s[k], a, b);
	for (int k = 1; k < CHAINS; k++)
		s[0] += s[k];
	return pm_simd_sum(s[0]);
}

static void multiply_add(void *with)
{
	double sum = 0;
#pragma omp parallel for schedule(static) reduction(+ : sum)
	for (int t = 0; t < pm_threads(); t++)
		sum += chains(t);
	*(double *)with = sum;
}

static void row(const char *name, const char *unit, double value, double spread)
{
	printf("machine\t%s\t%d\t%.1f\t%s\t%.0f%%\t-\t-\t-\t-\t-\t-\t-\t-\t-\n", name, pm_threads(), value, unit, 1e2 * spread);
	fflush(stdout);
}

static void measure(void)
{
	struct bandwidth_arrays all[BANDWIDTHS];
	struct bench_job jobs[BANDWIDTHS + 1];
	double kept;
	all[0] = bandwidth_new(ELEMENTS);
	for (int i = 0; i < BANDWIDTHS; i++) {
		all[i] = all[0];
		all[i].way = (enum bandwidth)i;
		jobs[i] = (struct bench_job){.run = bandwidth_pass, .with = &all[i]};
	}
	jobs[BANDWIDTHS] = (struct bench_job){.run = multiply_add, .with = &kept};
	bench_turns(BANDWIDTHS + 1, jobs);
	for (int i = 0; i < BANDWIDTHS; i++)
		row(bandwidth_names[i], "GB/s", bandwidth_rate(&all[i], &jobs[i]), bench_middle(jobs[i].seconds).spread);
	row("fma", "GFLOP/s", 2. * PM_SIMD_WIDTH * CHAINS * TURNS * pm_threads() / bench_median(&jobs[BANDWIDTHS]) / 1e9,
		bench_middle(jobs[BANDWIDTHS].seconds).spread);
	bandwidth_free(&all[0]);
}

int main(void)
{
	int most = pm_threads();
	pm_threads_use(1);
	measure();
	if (most > 1) {
		pm_threads_use(most);
		measure();
	}
	return 0;
}
