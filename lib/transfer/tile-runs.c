/* Runs of a stream that is nearly in the order of tiles: of each 64 particles in a row those of one tile are a run, with others between or not, so that most
 * particles go by whole registers, from which the others are left out. The runs of each tile by a stable counting sort. Stability makes the order
 * independent of the number of chunks, though 64 that go over the end of a chunk are two.
 * Cost: a pass over 64 tiles for each run among them, and two over the runs. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "transfer/tile-runs.h"

enum { W = PM_SIMD_WIDTH, MOST = PM_TILE_RUNS_MOST, few = 8 /* of a run: they go one by one */ };
static const unsigned all_lanes = (1u << W) - 1;

static size_t eights_of(uint64_t members)
{
	members |= members >> 4, members |= members >> 2, members |= members >> 1;
	return pm_simd_bits_of_word(members & 0x0101010101010101);
}

/* Those of m that are in this tile. */
static uint64_t members_of(uint32_t here, size_t m, const uint32_t *tile)
{
	uint64_t members = 0;
	size_t i = 0;
	for (; i + W <= m; i += W)
		members |= (uint64_t)(all_lanes & ~pm_simd_int_others(*(const pm_simd_int_at *)(tile + i), (int32_t)here)) << i;
	for (; i < m; i++)
		members |= (uint64_t)(tile[i] == here) << i;
	return members;
}

bool pm_tile_runs_find(struct pm_tile_finds *f, size_t at, size_t m, const uint32_t *tile)
{
	for (uint64_t left = ~(uint64_t)0 >> (PM_TILE_RUN - m); left;) {
		const uint32_t here = tile[__builtin_ctzll(left)];
		const uint64_t members = members_of(here, m, tile);
		if (f->n == f->room)
			return false;
		f->found[f->n++] = (struct pm_tile_found){here, (uint32_t)at, members};
		f->eights += eights_of(members);
		left &= ~members;
	}
	return true;
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

static void put_runs(struct pm_tile_runs *r, const struct pm_tile_finds *f, uint32_t *next, size_t *cursor)
{
	for (size_t i = 0; i < f->n; i++) {
		const struct pm_tile_found *found = &f->found[i];
		const size_t from = cursor[found->tile], to = from + pm_simd_bits_of_word(found->members), full = (from + PM_TILE_RUN - 1) / PM_TILE_RUN;
		const uint32_t k = next[found->tile]++;
		r->run[k] = (struct pm_tile_run){(uint32_t)from, found->at, found->members};
		if (full * PM_TILE_RUN < to)
			r->of[full] = k;
		cursor[found->tile] = to;
	}
}

static int make(struct pm_tile_runs *r, const struct pm_tile_finds *f, size_t columns, int chunks, size_t *cursor, uint32_t *next)
{
#pragma omp parallel for num_threads(chunks) schedule(static, 1)
	for (int k = 0; k < chunks; k++)
		for (size_t i = 0; i < f[k].n; i++)
			next[(size_t)k * columns + f[k].found[i].tile]++;
	r->n = add_up(next, columns, chunks);
	r->run = pm_alloc(r->n + 1, sizeof *r->run);
	r->of = pm_zalloc(r->all / PM_TILE_RUN + 1, sizeof *r->of);
	if (!r->run || !r->of)
		return -PM_DATA;
	r->run[r->n] = (struct pm_tile_run){.from = (uint32_t)r->all};
#pragma omp parallel for num_threads(chunks) schedule(static, 1)
	for (int k = 0; k < chunks; k++)
		put_runs(r, &f[k], next + (size_t)k * columns, cursor + (size_t)k * columns);
	return 0;
}

int pm_tile_runs_init(struct pm_tile_runs *r, const struct pm_tile_finds *f, size_t n, size_t tiles, int chunks, size_t *cursor)
{
	*r = (struct pm_tile_runs){.all = n};
	uint32_t *next = pm_zalloc((size_t)chunks * (tiles + 1), sizeof *next);
	const int status = next ? make(r, f, tiles + 1, chunks, cursor, next) : -PM_DATA;
	pm_free(next);
	return status;
}

void pm_tile_runs_free(struct pm_tile_runs *r)
{
	pm_free(r->run);
	pm_free(r->of);
	*r = (struct pm_tile_runs){.n = 0};
}

size_t pm_tile_runs_at(const struct pm_tile_runs *r, size_t p)
{
	const struct pm_tile_run *run = &r->run[pm_tile_run_of(r, p)];
	return run->at + pm_simd_bit(run->members, p - run->from);
}

/* Those of a run that are among m from p on, i of which have been. */
static uint64_t part_of(const struct pm_tile_run *run, size_t p, size_t m, size_t i)
{
	uint64_t members = run->members;
	if (run->from < p + i)
		members &= ~(uint64_t)0 << pm_simd_bit(members, p + i - run->from);
	const size_t left = m - i;
	if (pm_simd_bits_of_word(members) > left)
		members &= ((uint64_t)1 << pm_simd_bit(members, left)) - 1;
	return members;
}

/* Those of one register at `at`, of all arrays; i: where the first goes to. Lanes of others may be written by other threads meanwhile, and are thrown away.
 * spare: a whole register has room there. */
PM_SIMD_INLINE void take_some(int n, unsigned some, bool spare, const double *const from[], size_t at, double *const to[], size_t i)
{
	PM_SIMD_UNROLL
	for (int c = 0; c < n; c++) {
		const pm_simd v = pm_simd_pack(pm_simd_load_any(from[c] + at), some);
		if (spare)
			pm_simd_store_any(to[c] + i, v);
		else
			for (size_t l = 0; l < pm_simd_bits_of_byte(some); l++)
				to[c][i + l] = v[l];
	}
}

PM_SIMD_INLINE void put_some(int n, unsigned some, bool spare, const double *const from[], size_t i, double *const to[], size_t at)
{
	PM_SIMD_UNROLL
	for (int c = 0; c < n; c++) {
		pm_simd v = {0};
		if (spare)
			v = pm_simd_load_any(from[c] + i);
		else
			for (size_t l = 0; l < pm_simd_bits_of_byte(some); l++)
				v[l] = from[c][i + l];
		if (some == all_lanes)
			pm_simd_store_any(to[c] + at, v);
		else
			pm_simd_unpack_to(to[c] + at, v, some);
	}
}

PM_SIMD_INLINE void one_by_one(int n, bool put, uint64_t members, const double *const from[], double *const to[], size_t at, size_t i)
{
	for (; members; members &= members - 1, i++) {
		const size_t stands = at + (size_t)__builtin_ctzll(members);
		PM_SIMD_UNROLL
		for (int c = 0; c < n; c++)
			to[c][put ? stands : i] = from[c][put ? i : stands];
	}
}

PM_SIMD_INLINE void all_of_them(int n, bool put, const double *const from[], double *const to[], size_t at, size_t i)
{
	for (size_t l = 0; l < PM_TILE_RUN; l += W) {
		PM_SIMD_UNROLL
		for (int c = 0; c < n; c++)
			pm_simd_store_any(to[c] + (put ? at : i) + l, pm_simd_load_any(from[c] + (put ? i : at) + l));
	}
}

/* The numbers of members of the 64 from `at` on; the others' places hold m, of which i have been. */
PM_SIMD_INLINE void copy(int n, bool put, uint64_t members, const double *const from[], double *const to[], size_t at, size_t i, size_t m)
{
	const size_t first = (size_t)__builtin_ctzll(members) / W * W;
	at += first, members >>= first;
	for (; members; at += W) {
		const unsigned some = (unsigned)members & all_lanes;
		if (put)
			put_some(n, some, i + W <= m, from, i, to, at);
		else
			take_some(n, some, i + W <= m, from, at, to, i);
		i += pm_simd_bits_of_byte(some);
		members >>= W;
	}
}

PM_SIMD_INLINE void walk(int n, bool put, const struct pm_tile_runs *r, size_t p, size_t m, const double *const from[], double *const to[])
{
	const double *read[MOST];
	double *write[MOST];
	size_t i = 0;
	PM_SIMD_UNROLL
	for (int c = 0; c < n; c++)
		read[c] = from[c], write[c] = to[c];
	for (const struct pm_tile_run *run = &r->run[pm_tile_run_of(r, p)]; i < m; run++) {
		const uint64_t members = part_of(run, p, m, i);
		const size_t many = pm_simd_bits_of_word(members);
		if (many < few || (size_t)run->at + PM_TILE_RUN > r->all)
			one_by_one(n, put, members, read, write, run->at, i);
		else if (many == PM_TILE_RUN)
			all_of_them(n, put, read, write, run->at, i);
		else
			copy(n, put, members, read, write, run->at, i, m);
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
		for (uint64_t members = part_of(run, p, m, i); members; members &= members - 1)
			place[i++] = run->at + (uint32_t)__builtin_ctzll(members);
}

void pm_tile_runs_fetch(const struct pm_tile_runs *r, size_t p, size_t m, int n, const double *const from[])
{
	if (p >= r->all)
		return;
	for (const struct pm_tile_run *run = &r->run[pm_tile_run_of(r, p) + 1]; run->from < p + m && run->from < r->all; run++)
		for (int c = 0; c < n; c++) {
			const double *at = from[c] + run->at;
			if (pm_simd_bits_of_word(run->members) < few)
				__builtin_prefetch(at + __builtin_ctzll(run->members));
		}
}
