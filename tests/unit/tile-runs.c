/* Particles that stay, as runs: a stable counting sort particle by particle is the oracle. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "transfer/tile-runs.h"

enum { MOST = PM_TILE_RUNS_MOST, PIECE = 256 };

static size_t below(uint64_t p, uint64_t what, size_t n)
{
	double u[2];
	pm_random(11, p, what, u);
	return (size_t)(u[0] * (double)n);
}

/* Tiles that rise, but one particle in so many is elsewhere. */
static void fill(size_t n, size_t tiles, size_t apart, uint32_t *tile)
{
	for (size_t p = 0; p < n; p++)
		tile[p] = (uint32_t)(below(p, 0, apart) ? p * (tiles + 1) / n : below(p, 1, tiles + 1));
}

/* place[]: of each particle in order; cursor: for the runs. */
static void sort(size_t n, size_t tiles, int chunks, const uint32_t *tile, uint32_t *place, size_t *cursor)
{
	size_t at = 0;
	for (size_t t = 0; t <= tiles; t++)
		for (int k = 0; k < chunks; k++) {
			cursor[(size_t)k * (tiles + 1) + t] = at;
			for (size_t p = pm_tile_chunk(n, chunks, k); p < pm_tile_chunk(n, chunks, k + 1); p++)
				if (tile[p] == t)
					place[at++] = (uint32_t)p;
		}
}

/* The finds of each chunk, 64 particles at a time, at the end of a chunk fewer; each has its tile's members, none of them twice. */
static bool find(size_t n, const uint32_t *tile, int chunks, struct pm_tile_finds *f)
{
	bool right = true;
	for (int k = 0; k < chunks; k++) {
		f[k] = (struct pm_tile_finds){.found = pm_alloc(n, sizeof *f->found), .room = n};
		for (size_t p = pm_tile_chunk(n, chunks, k), end = pm_tile_chunk(n, chunks, k + 1), m; p < end; p += m) {
			m = end - p < PM_TILE_RUN ? end - p : PM_TILE_RUN;
			uint64_t seen = 0;
			size_t i = f[k].n;
			right = right && pm_tile_runs_find(&f[k], p, m, tile + p);
			for (; i < f[k].n; seen |= f[k].found[i++].members) {
				right = right && f[k].found[i].members && !(seen & f[k].found[i].members);
				for (size_t l = 0; l < PM_TILE_RUN; l++)
					if (f[k].found[i].members >> l & 1)
						right = right && l < m && tile[p + l] == f[k].found[i].tile;
			}
			right = right && seen == ~(uint64_t)0 >> (PM_TILE_RUN - m);
		}
	}
	return right;
}

static void check_room(void)
{
	uint32_t tile[PM_TILE_RUN] = {0};
	struct pm_tile_found found[3] = {{.tile = 0}};
	struct pm_tile_finds f = {.found = found, .room = 2};
	tile[3] = 7, tile[63] = 9;
	check(!pm_tile_runs_find(&f, 0, PM_TILE_RUN, tile) && f.n == 2 && !found[2].members, "three runs have no room in two");
}

static void check_runs(size_t n, size_t tiles, size_t apart, int chunks)
{
	struct pm_tile_finds f[3];
	uint32_t *tile = pm_alloc(n, sizeof *tile), *place = pm_alloc(n, sizeof *place), here[PIECE];
	size_t *cursor = pm_alloc((size_t)chunks * (tiles + 1), sizeof *cursor);
	double *from[MOST], *to[MOST], few[MOST][PIECE], *piece[MOST], *exact[MOST];
	struct pm_tile_runs r;
	bool same = true, back = true, together = true;
	for (int c = 0; c < MOST; c++) {
		from[c] = pm_alloc(n, sizeof(double)), to[c] = pm_alloc(n, sizeof(double)), piece[c] = few[c];
		for (size_t p = 0; p < n; p++)
			from[c][p] = (double)p + c / 8.;
	}
	fill(n, tiles, apart, tile);
	sort(n, tiles, chunks, tile, place, cursor);
	check(find(n, tile, chunks, f), "%zu particles, one in %zu elsewhere, %d chunks: each is found once, in its tile", n, apart, chunks);
	check(!pm_tile_runs_init(&r, f, n, tiles, chunks, cursor) && r.run, "%zu particles of %zu tiles have runs", n, tiles);
	for (int arrays = 1; arrays <= MOST; arrays++) {
		for (int c = 0; c < MOST; c++)
			memset(to[c], 255, n * sizeof(double));
		for (size_t p = 0, m; p < n; p += m) { /* pieces of all sizes, which begin anywhere in a run */
			m = 1 + below(p, 2, PIECE);
			m = m < n - p ? m : n - p;
			memset(few, 255, sizeof few);
			pm_tile_runs_fetch(&r, p + m, PIECE, arrays, (const double *const *)from);
			pm_tile_runs_take(&r, p, m, arrays, (const double *const *)from, piece);
			for (size_t i = m; i < PIECE; i++)
				for (int c = 0; c < MOST; c++)
					same = same && isnan(few[c][i]);
			pm_tile_runs_places(&r, p, m, here);
			for (int c = 0; c < MOST; c++) /* as who calls them may have them: with no room behind */
				exact[c] = few[c] + PIECE - m, memmove(exact[c], few[c], m * sizeof(double));
			pm_tile_runs_put(&r, p, m, arrays, (const double *const *)exact, to);
			for (int c = 0; c < MOST; c++)
				memmove(few[c], exact[c], m * sizeof(double));
			for (size_t i = 0; i < m; i++) {
				same = same && here[i] == place[p + i] && pm_tile_runs_at(&r, p + i) == place[p + i];
				for (int c = 0; c < arrays; c++)
					same = same && few[c][i] == from[c][place[p + i]];
			}
			if (tile[place[p]] == tile[place[p + m - 1]])
				together = together && pm_tile_runs_together(&r, p, m) == (place[p + m - 1] - place[p] == m - 1);
		}
		for (int c = 0; c < arrays; c++)
			back = back && !memcmp(to[c], from[c], n * sizeof(double));
	}
	check(same, "%zu particles, one in %zu elsewhere, %d chunks: places, and values taken, of the oracle", n, apart, chunks);
	check(back, "and each value is put back where it was");
	check(together, "what stands one behind the other, and only that, is together");
	pm_tile_runs_free(&r);
	for (int k = 0; k < chunks; k++)
		pm_free(f[k].found);
	for (int c = 0; c < MOST; c++)
		pm_free(from[c]), pm_free(to[c]);
	pm_free(tile), pm_free(place), pm_free(cursor);
}

int main(void)
{
	check_room();
	for (int chunks = 1; chunks <= 3; chunks++) {
		check_runs(1, 1, 3, chunks);
		check_runs(37, 2, 3, chunks);
		check_runs(1000, 7, 97, chunks);
		check_runs(1024, 3, 2, chunks);
		check_runs(5000, 40, 20, chunks);
	}
	return check_done();
}
