/* Runs of particles that stand one behind the other in a stream that is nearly in the order of tiles: those of each tile by a stable counting sort. Stability
 * makes the order independent of the number of chunks, though a run that goes over the end of a chunk is two.
 * Cost: two passes over the tiles, in which only changes take time. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "transfer/tile-runs.h"

enum { line = 8, MOST = PM_TILE_RUNS_MOST };

/* How many runs a chunk has in each tile. */
static void count_runs(const uint32_t *tile, size_t from, size_t to, uint32_t *count)
{
	for (size_t i = from; i < to; i = pm_tile_other(tile, i, to))
		count[tile[i]]++;
}

/* Counts become the numbers of each chunk's first runs; how many there are. */
static size_t add_up(uint32_t *count, size_t columns, int chunks)
{
	uint32_t all = 0;
	for (size_t t = 0; t < columns; t++)
		for (int k = 0; k < chunks; k++) {
			const uint32_t here = count[(size_t)k * columns + t];
			count[(size_t)k * columns + t] = all;
			all += here;
		}
	return all;
}

static void put_runs(struct pm_tile_runs *r, const uint32_t *tile, size_t from, size_t to, uint32_t *next, size_t *cursor)
{
	for (size_t i = from, end; i < to; i = end) {
		const uint32_t t = tile[i];
		end = pm_tile_other(tile, i, to);
		r->run[next[t]++] = (struct pm_tile_run){(uint32_t)cursor[t], (uint32_t)i};
		cursor[t] += end - i;
	}
}

/* The last run that begins at p or before. */
static size_t search(const struct pm_tile_runs *r, size_t p)
{
	size_t low = 0, high = r->n;
	while (high - low > 1) {
		const size_t middle = low + (high - low) / 2;
		if (r->run[middle].from <= p)
			low = middle;
		else
			high = middle;
	}
	return low;
}

static int make(struct pm_tile_runs *r, const uint32_t *tile, size_t columns, int chunks, size_t *cursor, uint32_t *next)
{
#pragma omp parallel for num_threads(chunks) schedule(static, 1)
	for (int k = 0; k < chunks; k++)
		count_runs(tile, pm_tile_chunk(r->all, chunks, k), pm_tile_chunk(r->all, chunks, k + 1), next + (size_t)k * columns);
	r->n = add_up(next, columns, chunks);
	r->run = pm_alloc(r->n + 1, sizeof *r->run);
	r->of = pm_alloc(r->all / PM_TILE_RUNS_EACH + 1, sizeof *r->of);
	if (!r->run || !r->of)
		return -PM_DATA;
	r->run[r->n] = (struct pm_tile_run){(uint32_t)r->all, 0};
#pragma omp parallel for num_threads(chunks) schedule(static, 1)
	for (int k = 0; k < chunks; k++)
		put_runs(r, tile, pm_tile_chunk(r->all, chunks, k), pm_tile_chunk(r->all, chunks, k + 1), next + (size_t)k * columns,
			cursor + (size_t)k * columns);
#pragma omp parallel for num_threads(chunks) schedule(static)
	for (size_t b = 0; b <= r->all / PM_TILE_RUNS_EACH; b++)
		r->of[b] = (uint32_t)search(r, b * PM_TILE_RUNS_EACH);
	return 0;
}

int pm_tile_runs_init(struct pm_tile_runs *r, const uint32_t *tile, size_t n, size_t tiles, int chunks, size_t *cursor)
{
	*r = (struct pm_tile_runs){.all = n};
	uint32_t *next = pm_zalloc((size_t)chunks * (tiles + 1), sizeof *next);
	const int status = next ? make(r, tile, tiles + 1, chunks, cursor, next) : -PM_DATA;
	pm_free(next);
	return status;
}

void pm_tile_runs_free(struct pm_tile_runs *r)
{
	pm_free(r->run);
	pm_free(r->of);
	*r = (struct pm_tile_runs){.n = 0};
}

/* Those of one run, of all arrays in one loop, whose end a processor foresees wrong once. spare: there is room for whole lines here and there. */
PM_SIMD_INLINE void copy(int n, size_t many, bool spare, const double *const from[], size_t at, double *const to[], size_t i)
{
	const double *here[MOST];
	double *there[MOST];
	size_t k = 0;
	PM_SIMD_UNROLL
	for (int c = 0; c < n; c++)
		here[c] = from[c] + at, there[c] = to[c] + i;
	for (; k + line <= many || (spare && k < many); k += line) {
		PM_SIMD_UNROLL
		for (int c = 0; c < n; c++)
			memcpy(there[c] + k, here[c] + k, line * sizeof(double));
	}
	if (k < many && many >= line) { /* the last line, some of it a second time */
		PM_SIMD_UNROLL
		for (int c = 0; c < n; c++)
			memcpy(there[c] + many - line, here[c] + many - line, line * sizeof(double));
		return;
	}
	for (; k < many; k++) {
		PM_SIMD_UNROLL
		for (int c = 0; c < n; c++)
			there[c][k] = here[c][k];
	}
}

PM_SIMD_INLINE void walk(int n, bool put, const struct pm_tile_runs *r, size_t p, size_t m, const double *const from[], double *const to[])
{
	size_t i = 0;
	for (const struct pm_tile_run *run = &r->run[pm_tile_run_of(r, p)]; i < m; run++) {
		const size_t at = run->at + (p + i - run->from), left = run[1].from - (p + i), many = left < m - i ? left : m - i;
		if (put)
			copy(n, many, false, from, i, to, at);
		else
			copy(n, many, i + many + line <= m && at + many + line <= r->all, from, at, to, i);
		i += many;
	}
}

PM_SIMD_INLINE void walk_any(int n, bool put, const struct pm_tile_runs *r, size_t p, size_t m, const double *const from[], double *const to[])
{
	switch (n) {
	case 1: walk(1, put, r, p, m, from, to); break;
	case 2: walk(2, put, r, p, m, from, to); break;
	case 3: walk(3, put, r, p, m, from, to); break;
	case 4: walk(4, put, r, p, m, from, to); break;
	case 5: walk(5, put, r, p, m, from, to); break;
	default: walk(MOST, put, r, p, m, from, to);
	}
}

void pm_tile_runs_take(const struct pm_tile_runs *r, size_t p, size_t m, int n, const double *const from[], double *const to[])
{
	walk_any(n, false, r, p, m, from, to);
}

void pm_tile_runs_put(const struct pm_tile_runs *r, size_t p, size_t m, int n, const double *const from[], double *const to[])
{
	walk_any(n, true, r, p, m, from, to);
}

void pm_tile_runs_places(const struct pm_tile_runs *r, size_t p, size_t m, uint32_t *place)
{
	size_t i = 0;
	for (const struct pm_tile_run *run = &r->run[pm_tile_run_of(r, p)]; i < m; run++)
		for (size_t end = run[1].from - p < m ? run[1].from - p : m; i < end; i++)
			place[i] = run->at + (uint32_t)(p + i - run->from);
}

void pm_tile_runs_fetch(const struct pm_tile_runs *r, size_t p, size_t m, int n, const double *const from[])
{
	if (p >= r->all)
		return;
	for (const struct pm_tile_run *run = &r->run[pm_tile_run_of(r, p) + 1]; run->from < p + m && run->from < r->all; run++)
		for (int c = 0; c < n; c++)
			__builtin_prefetch(from[c] + run->at);
}
