/* Particles that stay in the stream, in the order of tiles: runs of those that stand there one behind the other. For lib/transfer and lib/current.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_RUNS_H
#define PM_TRANSFER_TILE_RUNS_H

#include "transfer/transfer-axis.h"

/* Its first particle: number in the order, and where it stands. */
struct pm_tile_run {
	uint32_t from, at;
};

enum { PM_TILE_RUNS_EACH = 64, PM_TILE_RUNS_MOST = 6 };
struct pm_tile_runs {
	size_t n, all;           /* runs; particles */
	struct pm_tile_run *run; /* [n+1] in order, the last behind all; NULL: none stay */
	uint32_t *of;            /* [all/EACH+1] the run of each 64th particle in order */
};

/* Where chunk k of n particles begins, k <= chunks. */
static inline size_t pm_tile_chunk(size_t n, int chunks, int k) { return k == chunks ? n : n / (size_t)chunks * (size_t)k; }

/* The first particle behind i, before end, in another tile; or end. */
PM_SIMD_INLINE size_t pm_tile_other(const uint32_t *tile, size_t i, size_t end)
{
	const int32_t here = (int32_t)tile[i++];
	for (; i + PM_SIMD_WIDTH <= end; i += PM_SIMD_WIDTH) {
		const unsigned others = pm_simd_int_others(*(const pm_simd_int_at *)(tile + i), here);
		if (others)
			return i + (size_t)__builtin_ctz(others);
	}
	while (i < end && (int32_t)tile[i] == here)
		i++;
	return i;
}

/* From the tiles tile[n] of particles, n <= UINT32_MAX; cursor[chunks][tiles+1]: the order's number of each chunk's first particle of each tile, used up.
 * 0 or failure; free in any case. */
int pm_tile_runs_init(struct pm_tile_runs *r, const uint32_t *tile, size_t n, size_t tiles, int chunks, size_t *cursor);
void pm_tile_runs_free(struct pm_tile_runs *r);

/* The run of particle p of the order, where p stands, and whether the m from p on are in one run. */
static inline size_t pm_tile_run_of(const struct pm_tile_runs *r, size_t p)
{
	size_t k = r->of[p / PM_TILE_RUNS_EACH];
	while (r->run[k + 1].from <= p)
		k++;
	return k;
}
static inline size_t pm_tile_runs_at(const struct pm_tile_runs *r, size_t p)
{
	const struct pm_tile_run *run = &r->run[pm_tile_run_of(r, p)];
	return run->at + (p - run->from);
}
static inline bool pm_tile_runs_together(const struct pm_tile_runs *r, size_t p, size_t m) { return r->run[pm_tile_run_of(r, p) + 1].from >= p + m; }

/* Numbers of the m particles from p on, of n <= PM_TILE_RUNS_MOST arrays: from the stream to to[n][m], and back. */
void pm_tile_runs_take(const struct pm_tile_runs *r, size_t p, size_t m, int n, const double *const from[], double *const to[]);
void pm_tile_runs_put(const struct pm_tile_runs *r, size_t p, size_t m, int n, const double *const from[], double *const to[]);
/* Where each stands. */
void pm_tile_runs_places(const struct pm_tile_runs *r, size_t p, size_t m, uint32_t *place);
/* Fetches the first of each run that begins there. */
void pm_tile_runs_fetch(const struct pm_tile_runs *r, size_t p, size_t m, int n, const double *const from[]);

#endif
