/* Direct summation in billions of pairs per second (N^2 counted), compared with a plain loop that no method without symmetry can beat: four vectors of
 * targets in
 * registers, sources one by one, 1/r^3 from the approximate root with one correction of third order. SPDX-License-Identifier: GPL-3.0-or-later */
#include "far/pp.h"

#include "base/simd.h"
#include "bench.h"

enum { N = 16384, GROUP = 4 };

struct bodies {
	struct pm_pp how;
	double *x[3], *q, *g[3], *phi;
};

PM_SIMD_INLINE void meet(pm_simd x[3], const double *const y[3], const double *q, size_t j, pm_simd delta2, pm_simd g[3])
{
	pm_simd s[3], d2 = delta2;
	PM_SIMD_UNROLL
	for (int d = 0; d < 3; d++) {
		s[d] = x[d] - pm_simd_all(y[d][j]);
		d2 = pm_simd_fma(s[d], s[d], d2);
	}
	pm_simd r = pm_simd_rsqrt_start(d2), e = pm_simd_fnma(d2, r * r, pm_simd_all(1));
	r = pm_simd_fma(r * e, pm_simd_fma(e, pm_simd_all(0.375), pm_simd_all(0.5)), r);
	pm_simd f = r * r * (r * pm_simd_all(q[j]));
	PM_SIMD_UNROLL
	for (int d = 0; d < 3; d++)
		g[d] = pm_simd_fma(f, s[d], g[d]);
}

static void plain(void *with)
{
	struct bodies *b = with;
	const double *const y[3] = {b->x[0], b->x[1], b->x[2]};
	pm_simd delta2 = pm_simd_all(b->how.delta * b->how.delta);
#pragma omp parallel for schedule(static)
	for (size_t i = 0; i < N; i += GROUP * PM_SIMD_WIDTH) {
		pm_simd x[GROUP][3], g[GROUP][3] = {{{0}}};
		PM_SIMD_UNROLL
		for (size_t k = 0; k < GROUP; k++)
			PM_SIMD_UNROLL
			for (int d = 0; d < 3; d++)
				x[k][d] = pm_simd_load(b->x[d] + i + k * PM_SIMD_WIDTH);
		for (size_t j = 0; j < N; j++)
			PM_SIMD_UNROLL
			for (size_t k = 0; k < GROUP; k++)
				meet(x[k], y, b->q, j, delta2, g[k]);
		PM_SIMD_UNROLL
		for (size_t k = 0; k < GROUP; k++)
			PM_SIMD_UNROLL
			for (int d = 0; d < 3; d++)
				pm_simd_store(b->g[d] + i + k * PM_SIMD_WIDTH, g[k][d]);
	}
}

static void ours(void *with)
{
	struct bodies *b = with;
	uint64_t coincident;
	if (pm_pp_sum(&b->how, N, N, (const double *const *)b->x, b->q, b->g, b->phi, &coincident))
		exit(1);
}

static void measure(struct bodies full)
{
	struct bodies half = full, potential = full;
	full.how.half = potential.how.half = false, half.how.half = true;
	full.phi = half.phi = NULL;
	struct bench_job jobs[] = {{plain, &full, {0}}, {ours, &full, {0}}, {ours, &half, {0}}, {ours, &potential, {0}}};
	bench_turns(4, jobs);
	const double pairs = (double)N * N;
	/* Operations: those of the multiplier, two for each; subtractions have units of their own. */
	bench_rate((struct bench_row){.kernel = "pp", .name = "the plain loop", .unit = "Gpair/s", .per = 1e9, .flops = 28}, pairs, &jobs[0]);
	bench_against((struct bench_row){.kernel = "pp", .name = "full", .unit = "Gpair/s", .per = 1e9, .flops = 30, .least = 0.95}, pairs, &jobs[1],
		"plain loop", &jobs[0], 0);
	bench_against((struct bench_row){.kernel = "pp", .name = "half (default)", .unit = "Gpair/s", .per = 1e9, .flops = 22, .least = 0.95}, pairs, &jobs[2],
		"plain loop", &jobs[0], 0);
	bench_against((struct bench_row){.kernel = "pp", .name = "full, potential", .unit = "Gpair/s", .per = 1e9, .flops = 34}, pairs, &jobs[3],
		"plain loop", &jobs[0], 0);
	bench_against((struct bench_row){.kernel = "pp", .name = "half, REBOUND", .unit = "Gpair/s", .per = 1e9, .least = 6}, pairs, &jobs[2],
		"REBOUND", NULL, 0.665);
}

int main(void)
{
	struct bodies b = {.how = {.dim = 3, .delta = 0.01, .mollifier = pm_mollifier_find("plummer")}};
	int most = pm_threads();
	for (int d = 0; d < 3; d++)
		b.x[d] = pm_alloc(N, sizeof(double)), b.g[d] = pm_alloc(N, sizeof(double));
	b.q = pm_alloc(N, sizeof(double)), b.phi = pm_alloc(N, sizeof(double));
	for (size_t p = 0; p < N; p++) {
		double u[4];
		pm_random(1, p, 0, u), pm_random(1, p, 1, u + 2);
		b.x[0][p] = u[0], b.x[1][p] = u[1], b.x[2][p] = u[2], b.q[p] = 1. / N;
	}
	pm_threads_use(1);
	measure(b);
	if (most > 1) {
		pm_threads_use(most);
		measure(b);
	}
	return 0;
}
