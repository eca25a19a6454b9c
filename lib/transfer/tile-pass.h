/* Jobs over the tiles of an order, and the way of their blocks to and from the mesh: shared by densities, currents and gathers. Private to lib/transfer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_PASS_H
#define PM_TRANSFER_TILE_PASS_H

#include "transfer/tile-order.h"

struct pm_tile_job {
	size_t tile, from, to; /* records */
};

struct pm_tile_pass {
	const struct pm_grid *grid;
	const struct pm_tile_order *order;
	const struct pm_axis *axes; /* of the order */
	size_t jobs;
	struct pm_tile_job *job;
};

/* Where the slots of a block are on the mesh, for one component. */
struct pm_tile_target {
	const struct pm_axis *axes[3]; /* with the slots of the order's axes */
	const unsigned char *flip;     /* [3] of transfer.h */
	double scale;                  /* of what is added to the mesh */
	size_t line;                   /* the first line (j + points[1] k) of the mesh in memory: 0, or that of a rank's planes */
};

/* 0 or failure; free in any case. */
int pm_tile_pass_init(struct pm_tile_pass *p, const struct pm_grid *g, const struct pm_tile_order *o, const struct pm_axis *axes);
void pm_tile_pass_free(struct pm_tile_pass *p);

/* The slots of a tile along axis d: the first, and how many. */
size_t pm_tile_slots(const struct pm_tile_pass *p, size_t tile, int d, size_t *first);
/* Threads worth starting for n particles; and jobs between two barriers. */
int pm_tile_threads(size_t n);
size_t pm_tile_under_way(int threads);

/* The rows of a job's block that belong to this thread, added to the mesh; they are zero afterwards. */
void pm_tile_add_block(const struct pm_tile_pass *p, const struct pm_tile_job *j, const struct pm_tile_target *t, int thread, int threads,
	double *block, double *mesh);
/* One row of a block, of n slots, at slot z, y of its tile, to and from the points of its line; first: the slots where the tile begins. */
void pm_tile_add_row(const struct pm_tile_target *t, const size_t first[3], size_t n, size_t z, size_t y, double *row, double *line);
void pm_tile_load_row(const struct pm_tile_target *t, const size_t first[3], size_t n, size_t z, size_t y, const double *line, double *row);
enum { PM_TILE_PIECE = 16384 }; /* particles per job: a crowded tile is divided among threads and ranks */
/* The job that this thread most likely does after j, or NULL. */
const struct pm_tile_job *pm_tile_next(const struct pm_tile_pass *p, const struct pm_tile_job *j);
/* Asks for the points of a job's block, if there is one, into the second-level cache: they come while particles go by; as the block is added or read they
 * would be waited for. */
void pm_tile_fetch_mesh(const struct pm_tile_pass *p, const struct pm_tile_job *j, const struct pm_tile_target *t, const double *mesh);
/* The block of a job, read from the mesh. */
void pm_tile_load_block(const struct pm_tile_pass *p, const struct pm_tile_job *j, const struct pm_tile_target *t, const double *mesh, double *block);

#endif
