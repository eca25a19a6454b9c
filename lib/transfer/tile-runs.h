/* Particles that stay in the stream, in the order of tiles: of each 64 in a row, those of one tile are a run, with others between them or not. For
 * lib/transfer and lib/current. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_RUNS_H
#define PM_TRANSFER_TILE_RUNS_H

#include "transfer/transfer-axis.h"

/* Its first particle's number in the order; where the 64 begin, and which of them. */
struct pm_tile_run {
	uint32_t from, at;
	uint64_t members;
};

enum { PM_TILE_RUN = 64, PM_TILE_RUNS_MOST = 6 };
struct pm_tile_runs {
	size_t n, all;           /* runs; particles */
	struct pm_tile_run *run; /* [n+1] in order, the last behind all; NULL: none stay */
	uint32_t *of;            /* [all/RUN+1] the run of each 64th particle in order */
};

/* Where chunk k of n particles begins, k <= chunks. */
static inline size_t pm_tile_chunk(size_t n, int chunks, int k) { return k == chunks ? n : n / (size_t)chunks * (size_t)k; }

/* The runs of a chunk as they are found in the stream. */
struct pm_tile_found {
	uint32_t tile, at;
	uint64_t members;
};
struct pm_tile_finds {
	struct pm_tile_found *found; /* [room] */
	size_t n, room;
	size_t eights; /* of a run: how many of its eight lots of 8 particles in a row have some of it; summed over the runs */
};
/* Those of m <= 64 particles from `at` on, in tiles tile[m]. False: there is no room. */
bool pm_tile_runs_find(struct pm_tile_finds *f, size_t at, size_t m, const uint32_t *tile);

/* From the finds of each chunk of n particles, n <= UINT32_MAX; cursor[chunks][tiles+1]: the order's number of each chunk's first particle of each tile, used
 * up. 0 or failure; free in any case. */
int pm_tile_runs_init(struct pm_tile_runs *r, const struct pm_tile_finds *f, size_t n, size_t tiles, int chunks, size_t *cursor);
void pm_tile_runs_free(struct pm_tile_runs *r);

/* The run of particle p of the order, p < all, and where p stands. */
static inline size_t pm_tile_run_of(const struct pm_tile_runs *r, size_t p)
{
	size_t k = r->of[p / PM_TILE_RUN];
	while (r->run[k + 1].from <= p)
		k++;
	return k;
}
size_t pm_tile_runs_at(const struct pm_tile_runs *r, size_t p);
/* Whether the m > 0 from p on, of one tile, stand together: those of a tile have the order of the stream. */
static inline bool pm_tile_runs_together(const struct pm_tile_runs *r, size_t p, size_t m)
{
	return pm_tile_runs_at(r, p + m - 1) - pm_tile_runs_at(r, p) == m - 1;
}

/* Numbers of the m particles from p on, of 1 <= n <= PM_TILE_RUNS_MOST arrays: from the stream to to[n][m], and back. */
void pm_tile_runs_take(const struct pm_tile_runs *r, size_t p, size_t m, int n, const double *const from[], double *const to[]);
void pm_tile_runs_put(const struct pm_tile_runs *r, size_t p, size_t m, int n, const double *const from[], double *const to[]);
/* Where each stands. */
void pm_tile_runs_places(const struct pm_tile_runs *r, size_t p, size_t m, uint32_t *place);
/* Fetches the first of each run of a few that begins behind p, among those. */
void pm_tile_runs_fetch(const struct pm_tile_runs *r, size_t p, size_t m, int n, const double *const from[]);

#endif
