/* Particles in the order of tiles of cells. For lib/transfer and lib/current.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_ORDER_H
#define PM_TRANSFER_TILE_ORDER_H

#include "stream/column.h"
#include "transfer/tile-runs.h"
#include "transfer/transfer-columns.h"
#include "transfer/transfer-tile.h"

struct pm_tile_order {
	int dim, chunks;
	size_t n, tiles;
	uint32_t across[3];   /* tiles per axis; x runs fastest */
	uint32_t *tile;       /* [n] of each particle; `tiles` for strays; NULL where the stream is in order */
	size_t *begin;        /* [tiles+2] first record of each tile */
	size_t *cursor;       /* [chunks+1][tiles+1] */
	int stride;           /* doubles per record */
	double *records;      /* [n][stride]: u of each axis, then the values; NULL: spent, or, without tile[], the stream is in order */
	float *floats;        /* [n][packed] in place of records, where positions are floats: x, v of ways, and the values that are not one number; NULL */
	int packed;           /* floats per record there */
	bool columns;         /* positions or values are floats: they are read through blocks (pm_tile_order_pack) */
	struct pm_tile_runs runs; /* the particles in the order of the tiles, where they stay in the stream; else none */
	const struct pm_axis *axes;
	struct pm_column x[3], v[3];
	bool finite;          /* no position is NaN */
	bool assumed;         /* that the stream is in order, from some of it: who reads all of it finds out. Then cursor[] is not set */
	bool ways;            /* of the particles from x to x + v dt */
	double dt;
	int nvalues;
	struct pm_column values[PM_COMPONENTS];
};

/* Particles: n positions x[dim], and values[nvalues] that travel along. `stays`: not 0, and where the runs (tile-runs.h) of 64 particles have at most so many
 * eights, in the mean from the beginning of a thread's part up to any place of it, particles are not moved, and only the runs are kept. `finite`: no position
 * is NaN, which is to be found as a stray. `assume`: a stream of doubles that seems to be in order is taken to be (`assumed`, above). v[dim] not NULL: their
 * ways x..x + v dt, which stay, or become floats: from a stream of doubles that is far from the order of tiles neither records nor runs are made. */
enum { PM_STAY_FEW = 21, PM_STAY_WIDE = 26 }; /* measured: of one number or a vector; of E and B, or ways */
struct pm_tile_particles {
	int dim, nvalues;
	size_t n;
	const struct pm_column *x, *values;
	int stays;
	bool finite, assume;
	const struct pm_column *v;
	double dt;
};

/* Sorts particles by tile; within a tile they keep the order of the stream. The records have room for at least `room` doubles. 0 or failure; free in
 * any case. */
int pm_tile_order_init(struct pm_tile_order *o, const struct pm_axis axes[3], const struct pm_tile_particles *p, int room, struct pm_strays *strays);
void pm_tile_order_free(struct pm_tile_order *o);
/* Gives the records back when they hold results; the tiles stay. `again` makes those of the positions, which must be the same, with room for `room` doubles. */
void pm_tile_order_spend(struct pm_tile_order *o);
int pm_tile_order_again(struct pm_tile_order *o, int room);
static inline bool pm_tile_order_spent(const struct pm_tile_order *o) { return o->tile && !o->records && !o->floats; }
/* Records of the m particles in order from p on, m <= PM_TILE_ORDER_PACK; for a stream that is in order, or stays. Only where values are asked for need those
 * of the order still be there. Of ways a record is: where it begins, the signed length [cells] on each axis, the values. */
enum { PM_TILE_ORDER_PACK = 256, PM_TILE_AHEAD = 512 }; /* ahead: particles whose positions are fetched before they are needed */
/* Into the second-level cache: in the first, arrays of whole pages would put each other and the block out (p2m in the plane 0.8 of its time, m2p 0.93). */
static inline void pm_tile_fetch_ahead(const double *from) { __builtin_prefetch(from + PM_TILE_AHEAD, 0, 2); }
void pm_tile_order_pack(const struct pm_tile_order *o, size_t p, size_t m, bool values, double *records);
/* The same as arrays to[numbers of a record][m]; without values only u of each axis. */
void pm_tile_order_columns(const struct pm_tile_order *o, size_t p, size_t m, bool values, double *const to[]);
/* Its parts, of particles that stay: the values alone; signed lengths [cells] of m ways. */
void pm_tile_order_values(const struct pm_tile_order *o, size_t p, size_t m, double *const to[]);
void pm_tile_ways(double dt, double h, size_t m, const double *x, const double *v, double *length);
/* Whether m particles of the stream from p on, m <= PM_TILE_ORDER_PACK, are in this tile. */
bool pm_tile_order_all_in(const struct pm_tile_order *o, size_t tile, size_t p, size_t m);
/* m values from p on in order: where they stand together those of the stream, else put together in few[m]. */
const double *pm_tile_order_take(const struct pm_tile_order *o, size_t p, size_t m, const struct pm_column *from, double *few);
#endif
