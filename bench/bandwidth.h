/* Plain memory loops that set the limits (McCalpin's STREAM, with and without stores that bypass the caches), and a chain of fused
 * multiply-adds. Fixed shares per thread. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_BENCH_BANDWIDTH_H
#define PM_BENCH_BANDWIDTH_H

#ifdef __SSE2__
#include <immintrin.h>
#endif

#include "bench.h"

/* Eight numbers. */
enum { BANDWIDTH_LANES = 8 };
typedef double bandwidth_lanes __attribute__((vector_size(64), may_alias));

enum bandwidth { BANDWIDTH_READ, BANDWIDTH_COPY, BANDWIDTH_COPY_NT, BANDWIDTH_TRIAD, BANDWIDTH_TRIAD_NT, BANDWIDTH_UPDATE, BANDWIDTHS };
static const char *const bandwidth_names[] = {"read", "copy", "copy-nt", "triad", "triad-nt", "update"};
static const double bandwidth_bytes[] = {8, 16, 16, 24, 24, 16}; /* per element, without the cache line that a plain store reads first */

struct bandwidth_arrays {
	size_t n; /* a multiple of 32 */
	double *a, *b, *c;
	enum bandwidth way;
	double sum; /* so that no work is optimised away */
};

static inline bandwidth_lanes bandwidth_at(const double *p) { return *(const bandwidth_lanes *)p; }

static inline __attribute__((always_inline)) void bandwidth_past(double *p, bandwidth_lanes v)
{
#if defined __AVX512F__
	_mm512_stream_pd(p, (__m512d)v);
#elif defined __SSE2__
	for (int l = 0; l < BANDWIDTH_LANES; l += 2)
		_mm_stream_pd(p + l, _mm_set_pd(v[l + 1], v[l]));
#else
	*(bandwidth_lanes *)p = v;
#endif
}

static inline __attribute__((always_inline)) void bandwidth_fence(void)
{
#ifdef __SSE2__
	_mm_sfence();
#endif
}

/* from, to: multiples of 32. */
static inline __attribute__((always_inline)) void bandwidth_share(enum bandwidth way, size_t from, size_t to, double *a, const double *b, const double *c,
	bandwidth_lanes sum[4])
{
	for (size_t i = from; i < to; i += 4 * BANDWIDTH_LANES)
		_Pragma("GCC unroll 8")
		for (size_t k = 0; k < 4; k++) {
			size_t at = i + k * BANDWIDTH_LANES;
			if (way == BANDWIDTH_READ)
				sum[k] += bandwidth_at(b + at);
			else if (way == BANDWIDTH_COPY)
				*(bandwidth_lanes *)(a + at) = (bandwidth_at(b + at));
			else if (way == BANDWIDTH_COPY_NT)
				bandwidth_past(a + at, bandwidth_at(b + at));
			else if (way == BANDWIDTH_TRIAD)
				*(bandwidth_lanes *)(a + at) = (bandwidth_at(b + at) + 3 * bandwidth_at(c + at));
			else if (way == BANDWIDTH_TRIAD_NT)
				bandwidth_past(a + at, bandwidth_at(b + at) + 3 * bandwidth_at(c + at));
			else
				*(bandwidth_lanes *)(a + at) = (3 * bandwidth_at(a + at));
		}
	bandwidth_fence();
}

/* One pass over the arrays of this kind. */
static inline void bandwidth_pass(void *with)
{
	struct bandwidth_arrays *w = with;
	enum { PIECE = 32768 };
	double total = 0;
#pragma omp parallel for schedule(static) reduction(+ : total)
	for (size_t i = 0; i < w->n; i += PIECE) {
		size_t to = i + PIECE < w->n ? i + PIECE : w->n;
		bandwidth_lanes s[4] = {{0}};
		switch (w->way) {
		case BANDWIDTH_READ: bandwidth_share(BANDWIDTH_READ, i, to, w->a, w->b, w->c, s); break;
		case BANDWIDTH_COPY: bandwidth_share(BANDWIDTH_COPY, i, to, w->a, w->b, w->c, s); break;
		case BANDWIDTH_COPY_NT: bandwidth_share(BANDWIDTH_COPY_NT, i, to, w->a, w->b, w->c, s); break;
		case BANDWIDTH_TRIAD: bandwidth_share(BANDWIDTH_TRIAD, i, to, w->a, w->b, w->c, s); break;
		case BANDWIDTH_TRIAD_NT: bandwidth_share(BANDWIDTH_TRIAD_NT, i, to, w->a, w->b, w->c, s); break;
		default: bandwidth_share(BANDWIDTH_UPDATE, i, to, w->a, w->b, w->c, s);
		}
		s[0] = (s[0] + s[1]) + (s[2] + s[3]);
		for (int l = 0; l < BANDWIDTH_LANES; l++)
			total += s[0][l];
	}
	w->sum = total;
}

static inline double bandwidth_rate(const struct bandwidth_arrays *w, const struct bench_job *j) /* GB/s */
{
	return bandwidth_bytes[w->way] * (double)w->n / bench_median(j) / 1e9;
}

/* A kernel limited by memory: its rate and, in the same rounds, the bandwidth of a plain loop. */
static inline void bandwidth_row(const char *kernel, const char *name, double bytes, double flops, double items, const struct bench_job *j,
	const struct bandwidth_arrays *w, const struct bench_job *plain)
{
	double limit = bandwidth_rate(w, plain) * 1e3 / bytes;
	char against[32];
	snprintf(against, sizeof against, "%s loop", bandwidth_names[w->way]);
	double itself[BENCH_ROUNDS], others = bandwidth_bytes[w->way] * (double)w->n;
	for (int r = 0; r < BENCH_ROUNDS; r++)
		itself[r] = bytes * items / j->seconds[r] / (others / plain->seconds[r]);
	bench_rate((struct bench_row){.kernel = kernel, .name = name, .unit = "M/s", .per = 1e6, .bytes = bytes, .flops = flops, .limit = limit,
		.against = against, .other = limit, .ratio = bench_middle(itself).median, .least = 0.8}, items, j);
}

static inline struct bandwidth_arrays bandwidth_new(size_t n)
{
	struct bandwidth_arrays w = {.n = n, .a = pm_zalloc(n, 8), .b = pm_zalloc(n, 8), .c = pm_zalloc(n, 8)};
	if (!w.a || !w.b || !w.c)
		exit(1);
	for (size_t i = 0; i < n; i++)
		w.a[i] = w.b[i] = w.c[i] = 0;
	return w;
}

static inline void bandwidth_free(struct bandwidth_arrays *w) { pm_free(w->a), pm_free(w->b), pm_free(w->c); }

#endif
