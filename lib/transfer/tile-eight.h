/* Eight particles of a tile at a time (four, where a register holds no more), for cic: from records or from the stream, to records or to the stream.
 * Private to lib/transfer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_EIGHT_H
#define PM_TRANSFER_TILE_EIGHT_H

#include "transfer/tile-cic.h"

/* w[k][l] to to[turned(l) + k]. */
PM_SIMD_INLINE size_t turned(size_t l) { return l % 4 * PM_SIMD_WIDTH + l / 4 * 4; }

PM_SIMD_INLINE void turn_out(const pm_simd w[4], double *to)
{
	pm_simd v[4];
	pm_simd_turn(w, v);
	PM_SIMD_UNROLL
	for (size_t k = 0; k < 4; k++)
		pm_simd_store(to + PM_SIMD_WIDTH * k, v[k]);
}

/* Eight particles: cell within the tile, distances from its lower corner. */
struct eight {
	pm_simd_int cell[3];
	pm_simd distance[3];
};

/* Of these records; *fourth: what comes behind the position in each. */
PM_SIMD_INLINE struct eight find_eight_at(const struct pm_tile *t, const double *const record[PM_SIMD_WIDTH], pm_simd *fourth)
{
	struct eight e;
	pm_simd v[4], u[4];
	PM_SIMD_UNROLL
	for (size_t k = 0; k < 4; k++)
		v[k] = pm_simd_fours(record, k);
	pm_simd_turn(v, u);
	PM_SIMD_UNROLL
	for (int d = 0; d < 3; d++) {
		e.distance[d] = pm_simd_split(u[d], &e.cell[d]);
		e.cell[d] -= (int32_t)t->cell[d];
	}
	*fourth = u[3];
	return e;
}

/* Those from i on. The last ones may be fewer: the first of them stands in for the rest. */
PM_SIMD_INLINE struct eight find_eight_of_records(const struct pm_tile *t, size_t i, pm_simd *fourth)
{
	const double *record[PM_SIMD_WIDTH];
	PM_SIMD_UNROLL
	for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
		record[l] = t->records + (i + (i + l < t->count ? l : 0)) * (size_t)t->stride;
	return find_eight_at(t, record, fourth);
}

/* The same in the plane; *third, *fourth: what comes behind the position. */
PM_SIMD_INLINE struct eight find_eight_in_plane(const struct pm_tile *t, size_t i, pm_simd *third, pm_simd *fourth)
{
	struct eight e;
	pm_simd v[4], u[4];
	const double *record[PM_SIMD_WIDTH];
	PM_SIMD_UNROLL
	for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
		record[l] = t->records + (i + (i + l < t->count ? l : 0)) * (size_t)t->stride;
	PM_SIMD_UNROLL
	for (size_t k = 0; k < 4; k++)
		v[k] = pm_simd_fours(record, k);
	pm_simd_turn(v, u);
	PM_SIMD_UNROLL
	for (int d = 0; d < 2; d++) {
		e.distance[d] = pm_simd_split(u[d], &e.cell[d]);
		e.cell[d] -= (int32_t)t->cell[d];
	}
	*third = u[2], *fourth = u[3];
	return e;
}

/* Those of a batch from i on, in the same way; `dim` axes of them. */
PM_SIMD_INLINE struct eight find_eight_of(int dim, const struct pm_tile *t, const struct pm_tile_batch *b, size_t i)
{
	struct eight e;
	PM_SIMD_UNROLL
	for (int d = 0; d < dim; d++) {
		const double *x = b->x[d] + i;
		__builtin_prefetch(b->next[d] + i, 0, 2);
		double few[PM_SIMD_WIDTH];
		unsigned outside;
		if (i + PM_SIMD_WIDTH > b->m) {
			for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
				few[l] = x[i + l < b->m ? l : 0];
			x = few;
		}
		pm_simd u = pm_axis_locate_eight(&b->lanes[d], pm_simd_load_any(x), &outside);
		if (outside) {
			double far[PM_SIMD_WIDTH];
			pm_simd_store_any(far, u);
			pm_axis_locate_far(&b->order->axes[d], outside, PM_SIMD_WIDTH, x, far);
			u = pm_simd_load_any(far);
		}
		e.distance[d] = pm_simd_split(u, &e.cell[d]);
		e.cell[d] -= (int32_t)t->cell[d];
	}
	return e;
}

PM_SIMD_INLINE struct eight find_eight(const struct pm_tile *t, const struct pm_tile_batch *b, size_t i) { return find_eight_of(3, t, b, i); }

/* Where the particles of a piece of a batch are, found in a loop of their own: the one that loads by these addresses would wait for them, as fewer particles
 * are under way at once than the time from a position to its address is long (0.85 of the time of m2p with eight in a cell). */
struct places {
	double distance[3][PM_TILE_ORDER_PACK] __attribute__((aligned(64)));
	int32_t at[PM_TILE_ORDER_PACK] __attribute__((aligned(64)));
};
typedef pm_simd_int number_of(const struct eight *e); /* of a cell or a point */

PM_SIMD_INLINE void put_eight(int dim, const struct eight *e, number_of *number, size_t i, struct places *to)
{
	PM_SIMD_UNROLL
	for (int d = 0; d < dim; d++)
		pm_simd_store(to->distance[d] + i, e->distance[d]);
	*(pm_simd_int_at *)(to->at + i) = number(e);
}

/* Those from `from` on, as many as there is room for; where the next piece begins. */
PM_SIMD_INLINE size_t find_places(int dim, const struct pm_tile *t, const struct pm_tile_batch *b, size_t from, number_of *number, struct places *to)
{
	const struct pm_tile_batch mine = *b; /* its numbers stay in registers: what is stored here might be those of the caller */
	const size_t end = b->m - from < PM_TILE_ORDER_PACK ? b->m : from + PM_TILE_ORDER_PACK;
	for (size_t i = from; i < end; i += PM_SIMD_WIDTH) {
		const struct eight e = find_eight_of(dim, t, &mine, i);
		put_eight(dim, &e, number, i - from, to);
	}
	return end;
}

/* Their first points in a block. */
PM_SIMD_INLINE pm_simd_int node_of(const struct eight *e)
{
	return (e->cell[2] * pm_block_rows[3] + e->cell[1]) * pm_block_row[3] + e->cell[0];
}

/* Where the values of a component go: outside of the loops, since what these store might be what is read here. */
struct delivery {
	const double *factor; /* NULL: times */
	double times, *to;
	bool set;
};
PM_SIMD_INLINE struct delivery delivery_of(const struct pm_tile_results *r, int c)
{
	return (struct delivery){r->factor[c].doubles, r->factor[c].value, r->to[c].doubles, r->set[c]};
}

/* The first n of eight values to the particles from p on. v - v is 0, or NaN if v is not finite. */
PM_SIMD_INLINE void deliver_eight(pm_simd v, size_t n, const struct delivery *d, size_t p, pm_simd *nothing)
{
	double *to = d->to + p;
	if (n == PM_SIMD_WIDTH) {
		v = (d->factor ? pm_simd_load_any(d->factor + p) : pm_simd_all(d->times)) * v;
		v = d->set ? v : pm_simd_load_any(to) + v;
		pm_simd_store_any(to, v);
		__builtin_prefetch(to + PM_TILE_AHEAD, 1);
		*nothing += v - v;
		return;
	}
	double few[PM_SIMD_WIDTH];
	pm_simd_store_any(few, v);
	for (size_t l = 0; l < n; l++) {
		const double value = (d->factor ? d->factor[p + l] : d->times) * few[l];
		to[l] = d->set ? value : to[l] + value;
		*nothing += to[l] - to[l];
	}
}

/* The two points of a row that begin at at[] of each particle. */
PM_SIMD_INLINE void load_pairs(const double *block, const int32_t *at, pm_simd *low, pm_simd *high)
{
	pm_simd4_at lows[PM_SIMD_WIDTH / 4], highs[PM_SIMD_WIDTH / 4];
	PM_SIMD_UNROLL
	for (size_t four = 0; four < PM_SIMD_WIDTH / 4; four++) {
		const double *from[4];
		pm_simd4_at pair[2];
		PM_SIMD_UNROLL
		for (size_t l = 0; l < 4; l++)
			from[l] = block + (size_t)(uint32_t)at[4 * four + l];
		pm_simd4_pairs(from, 0, pair);
		lows[four] = pair[0], highs[four] = pair[1];
	}
	*low = pm_simd_of_fours(lows), *high = pm_simd_of_fours(highs);
}

#endif
