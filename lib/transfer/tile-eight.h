/* Eight particles of a tile at a time, for cic in 3-D: from records or from the stream, to records or to the stream. Private to lib/transfer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_EIGHT_H
#define PM_TRANSFER_TILE_EIGHT_H

#include "base/simd.h"
#include "transfer/tile-cic.h"

/* A matrix of 4 x 8 turned in two halves of 4 x 4: lane l of v[k] becomes lane k of to[l], and lane 4 + l lane 4 + k. */
PM_SIMD_INLINE void turn(const pm_simd v[4], pm_simd to[4])
{
	const pm_simd a = __builtin_shufflevector(v[0], v[1], 0, 8, 2, 10, 4, 12, 6, 14), b = __builtin_shufflevector(v[0], v[1], 1, 9, 3, 11, 5, 13, 7, 15);
	const pm_simd c = __builtin_shufflevector(v[2], v[3], 0, 8, 2, 10, 4, 12, 6, 14), d = __builtin_shufflevector(v[2], v[3], 1, 9, 3, 11, 5, 13, 7, 15);
	to[0] = __builtin_shufflevector(a, c, 0, 1, 8, 9, 4, 5, 12, 13);
	to[1] = __builtin_shufflevector(b, d, 0, 1, 8, 9, 4, 5, 12, 13);
	to[2] = __builtin_shufflevector(a, c, 2, 3, 10, 11, 6, 7, 14, 15);
	to[3] = __builtin_shufflevector(b, d, 2, 3, 10, 11, 6, 7, 14, 15);
}

/* w[k][l] to to[turned[l] + k]. */
static const size_t turned[PM_SIMD_WIDTH] = {0, 8, 16, 24, 4, 12, 20, 28};

PM_SIMD_INLINE void turn_out(const pm_simd w[4], double *to)
{
	pm_simd v[4];
	turn(w, v);
	PM_SIMD_UNROLL
	for (size_t k = 0; k < 4; k++)
		pm_simd_store(to + PM_SIMD_WIDTH * k, v[k]);
}

/* Eight particles: cell within the tile, distances from its lower corner. */
struct eight {
	pm_simd_int cell[3];
	pm_simd distance[3];
};

/* Of m records, those from i on; *fourth: what comes behind the position in each. The last ones may be fewer: the first of them stands in for the rest. */
PM_SIMD_INLINE struct eight find_eight_of_records(const struct pm_tile *t, size_t i, pm_simd *fourth)
{
	struct eight e;
	const double *record[PM_SIMD_WIDTH];
	pm_simd v[4], u[4];
	PM_SIMD_UNROLL
	for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
		record[l] = t->records + (i + (i + l < t->count ? l : 0)) * (size_t)t->stride;
	PM_SIMD_UNROLL
	for (size_t k = 0; k < 4; k++)
		v[k] = pm_simd_fours(record[k], record[k + 4]);
	turn(v, u);
	PM_SIMD_UNROLL
	for (int d = 0; d < 3; d++) {
		e.distance[d] = pm_simd_split(u[d] + t->lift[d], &e.cell[d]);
		e.cell[d] -= (int32_t)t->cell[d];
	}
	*fourth = u[3];
	return e;
}

/* Those of a batch from i on, in the same way. */
PM_SIMD_INLINE struct eight find_eight(const struct pm_tile *t, const struct pm_tile_batch *b, size_t i)
{
	struct eight e;
	for (int d = 0; d < 3; d++) {
		const double *x = b->order->x[d] + b->p + i;
		double few[PM_SIMD_WIDTH];
		unsigned outside;
		if (i + PM_SIMD_WIDTH > b->m) {
			for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
				few[l] = x[i + l < b->m ? l : 0];
			x = few;
		}
		__builtin_prefetch(x + PM_TILE_AHEAD);
		pm_simd u = pm_axis_locate_eight(&b->lanes[d], pm_simd_load_any(x), &outside);
		if (outside) {
			double far[PM_SIMD_WIDTH];
			pm_simd_store_any(far, u);
			pm_axis_locate_far(&b->order->axes[d], outside, PM_SIMD_WIDTH, x, far);
			u = pm_simd_load_any(far);
		}
		e.distance[d] = pm_simd_split(u + t->lift[d], &e.cell[d]);
		e.cell[d] -= (int32_t)t->cell[d];
	}
	return e;
}

/* Their cells, x fastest; those of a gather. */
PM_SIMD_INLINE pm_simd_int cell_of(const struct eight *e)
{
	return (((e->cell[2] << pm_tile_shift[3][1]) + e->cell[1]) << pm_tile_shift[3][0]) + e->cell[0];
}
PM_SIMD_INLINE pm_simd_int gather_cell_of(const struct eight *e)
{
	return (e->cell[2] * PM_GATHER_ROWS + e->cell[1]) * PM_GATHER_ROW + e->cell[0];
}

/* The first n of eight values to their places. v - v is 0, or NaN if v is not finite. */
PM_SIMD_INLINE void deliver_eight(pm_simd v, size_t n, const double *factor, bool set, double *to, pm_simd *nothing)
{
	if (n == PM_SIMD_WIDTH) {
		v = factor ? pm_simd_load_any(factor) * v : v;
		v = set ? v : pm_simd_load_any(to) + v;
		pm_simd_store_any(to, v);
		__builtin_prefetch(to + PM_TILE_AHEAD, 1);
		*nothing += v - v;
		return;
	}
	double few[PM_SIMD_WIDTH];
	pm_simd_store_any(few, v);
	for (size_t l = 0; l < n; l++) {
		const double value = factor ? factor[l] * few[l] : few[l];
		to[l] = set ? value : to[l] + value;
		*nothing += to[l] - to[l];
	}
}

#endif
