/* Cloud in cell in 3-D, the everyday kernel. Spread: the eight corners of a cell lie side by side, so that a particle is one addition of eight numbers to its
 * cell; the corners are added up once a tile. Eight particles at a time, from records or straight from a stream in the order of tiles, find their places and
 * weights, which are then turned into one vector a particle. Gather: the two points of a row are loaded for eight particles and turned into two vectors.
 * Every sum has the order of the loops for all kernels: the same bytes. SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/tile-eight.h"

/* Weights of the corner of a cell at x*4 + y*2 + z. */
void pm_tile_cic_spread_records(const struct pm_tile *t)
{
	const int *shift = pm_tile_shift[3];
	const pm_simd8_at one_x = {1, 1, 1, 1, 0, 0, 0, 0}, one_y = {1, 1, 0, 0, 1, 1, 0, 0}, one_z = {1, 0, 1, 0, 1, 0, 1, 0};
	const pm_simd8_at sign_x = 1 - 2 * one_x, sign_y = 1 - 2 * one_y, sign_z = 1 - 2 * one_z;
	const size_t stride = (size_t)t->stride, value = (size_t)t->value;
	const pm_simd4_int_at first = {(int32_t)t->cell[0], (int32_t)t->cell[1], (int32_t)t->cell[2], 0};
	for (size_t i = 0; i < t->count; i++) {
		const double *record = t->records + i * stride;
		double distance[4];
		int32_t cell[4];
		pm_simd4_at u = *(const pm_simd4_at *)record;
		pm_simd4_int_at floor_u = __builtin_convertvector(u, pm_simd4_int_at);
		*(pm_simd4_at *)distance = u - __builtin_convertvector(floor_u, pm_simd4_at);
		*(pm_simd4_int_at *)cell = floor_u - first;
		size_t at = (((size_t)cell[2] << shift[1]) + (size_t)cell[1]) << shift[0] | (size_t)cell[0];
		pm_simd8_at *corners = (pm_simd8_at *)(t->corners + at * PM_CORNERS);
		*corners += (one_z + sign_z * distance[2]) * record[value] * (one_y + sign_y * distance[1]) * (one_x + sign_x * distance[0]);
	}
}

PM_SIMD_INLINE void add_to_cell(double *restrict corners, int32_t cell, const double *yz, double x)
{
	pm_simd_add_below_above(corners + (size_t)(uint32_t)cell * PM_CORNERS, yz, x);
}

/* What eight particles add to the corners of their cells, for the loop that adds. */
struct shares {
	double yz[PM_TILE_ORDER_PACK * 4] __attribute__((aligned(64))), x[PM_TILE_ORDER_PACK] __attribute__((aligned(64)));
	int32_t at[PM_TILE_ORDER_PACK] __attribute__((aligned(64)));
};

PM_SIMD_INLINE void share(const struct eight *e, pm_simd strength, size_t i, struct shares *s)
{
	const pm_simd low = (1 - e->distance[2]) * strength, high = e->distance[2] * strength, y = e->distance[1], below = 1 - y;
	*(pm_simd_int_at *)(s->at + i) = cell_of(e);
	pm_simd_store(s->x + i, e->distance[0]);
	turn_out((const pm_simd[]){low * below, high * below, low * y, high * y}, s->yz + 4 * i);
}

PM_SIMD_INLINE void add_shares(const struct shares *s, size_t m, double *corners)
{
	size_t i = 0;
	for (; i + PM_SIMD_WIDTH <= m; i += PM_SIMD_WIDTH) {
		PM_SIMD_UNROLL
		for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
			add_to_cell(corners, s->at[i + l], s->yz + 4 * i + turned(l), s->x[i + l]);
	}
	for (size_t l = 0; i + l < m; l++)
		add_to_cell(corners, s->at[i + l], s->yz + 4 * i + turned(l), s->x[i + l]);
}

void pm_tile_cic_spread(const struct pm_tile *t, const struct pm_tile_batch *batch, const double *q)
{
	const size_t m = batch->m;
	struct shares s;
	double few[PM_SIMD_WIDTH] = {0};
	for (size_t i = 0; i < m; i += PM_SIMD_WIDTH) {
		const struct eight e = find_eight(t, batch, i);
		pm_simd strength;
		if (i + PM_SIMD_WIDTH <= m) {
			strength = pm_simd_load_any(q + i);
		} else {
			memcpy(few, q + i, (m - i) * sizeof *q);
			strength = pm_simd_load_any(few);
		}
		pm_tile_fetch_ahead(q + i);
		share(&e, strength, i, &s);
	}
	add_shares(&s, m, t->corners);
}

void pm_tile_cic_spread_eight(const struct pm_tile *all)
{
	struct pm_tile t = *all;
	struct shares s;
	for (size_t from = 0; from < all->count; from += PM_TILE_ORDER_PACK) {
		t.records = all->records + from * (size_t)t.stride;
		t.count = all->count - from < PM_TILE_ORDER_PACK ? all->count - from : PM_TILE_ORDER_PACK;
		for (size_t i = 0; i < t.count; i += PM_SIMD_WIDTH) {
			pm_simd strength;
			const struct eight e = find_eight_of_records(&t, i, &strength);
			if (t.value != 3) {
				double few[PM_SIMD_WIDTH];
				for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
					few[l] = t.records[(i + (i + l < t.count ? l : 0)) * (size_t)t.stride + (size_t)t.value];
				strength = pm_simd_load_any(few);
			}
			share(&e, strength, i, &s);
		}
		add_shares(&s, t.count, t.corners);
	}
}

typedef pm_simd8_at corners_at;
typedef pm_simd4_at four_at;

/* The corners of one row of cells, folded along x: point i has the lower half of cell i and the upper half of cell i-1; [y*2 + z] each, zero beyond n. Two
 * cells at a time where a register holds eight. */
static void fold_row_by_two(size_t n, double *restrict corners, double *restrict to)
{
	const corners_at zero = {0};
	corners_at before = zero;
	size_t i = 0;
	for (; i < n; i += 2) { /* rows of corners are of even length */
		corners_at *cells = (corners_at *)(corners + i * PM_CORNERS);
		const corners_at a = cells[0], b = cells[1];
		const corners_at lower = __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
		const corners_at upper = __builtin_shufflevector(before, a, 4, 5, 6, 7, 12, 13, 14, 15);
		*(corners_at *)(to + 4 * i) = lower + upper;
		cells[0] = cells[1] = zero;
		before = b;
	}
	*(corners_at *)(to + 4 * i) = __builtin_shufflevector(before, zero, 4, 5, 6, 7, 8, 9, 10, 11);
	for (i += 2; i % 8; i += 2)
		*(corners_at *)(to + 4 * i) = zero;
}

static void fold_row(size_t n, double *restrict corners, double *restrict to)
{
	const four_at zero = {0};
	four_at before = zero;
	size_t i = 0;
	for (; i < n; i++) {
		four_at *cell = (four_at *)(corners + i * PM_CORNERS);
		*(four_at *)(to + 4 * i) = cell[0] + before;
		before = cell[1];
		cell[0] = cell[1] = zero;
	}
	*(four_at *)(to + 4 * i) = before;
	for (i++; i % 8; i++)
		*(four_at *)(to + 4 * i) = zero;
}

/* The pairs [y] of a folded row, with those that the row before has left, to two rows of the block; the pairs [y + 1] are left for the next. */
static void add_pairs_by_eight(size_t n, const double *restrict folded, double *restrict before, bool first, double *restrict low, double *restrict high)
{
	for (size_t i = 0; i < n; i += 8) {
		corners_at here[2];
		for (size_t k = 0; k < 2; k++) {
			const corners_at a = *(const corners_at *)(folded + 4 * i + 16 * k), b = *(const corners_at *)(folded + 4 * i + 16 * k + 8);
			corners_at *left = (corners_at *)(before + 2 * i + 8 * k);
			here[k] = __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13) + *left;
			*left = __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15);
		}
		corners_at even = __builtin_shufflevector(here[0], here[1], 0, 2, 4, 6, 8, 10, 12, 14);
		if (!first)
			even += *(corners_at *)(low + i);
		*(corners_at *)(low + i) = even;
		*(corners_at *)(high + i) = __builtin_shufflevector(here[0], here[1], 1, 3, 5, 7, 9, 11, 13, 15);
	}
}

static void add_pairs(size_t n, const double *restrict folded, double *restrict before, bool first, double *restrict low, double *restrict high)
{
	for (size_t i = 0; i < n; i += 4) {
		four_at *left = (four_at *)(before + 2 * i);
		const double *from = folded + 4 * i;
		const four_at p = *(const four_at *)from, q = *(const four_at *)(from + 4), r = *(const four_at *)(from + 8), s = *(const four_at *)(from + 12);
		const four_at a = __builtin_shufflevector(p, q, 0, 4, 2, 6), b = __builtin_shufflevector(p, q, 1, 5, 3, 7);
		const four_at c = __builtin_shufflevector(r, s, 0, 4, 2, 6), d = __builtin_shufflevector(r, s, 1, 5, 3, 7);
		four_at even = __builtin_shufflevector(a, c, 0, 1, 4, 5) + left[0];
		*(four_at *)(high + i) = __builtin_shufflevector(b, d, 0, 1, 4, 5) + left[1];
		if (!first)
			even += *(four_at *)(low + i);
		*(four_at *)(low + i) = even;
		left[0] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
		left[1] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
	}
}

void pm_tile_cic_fold(const struct pm_tile *t, const size_t cells[3])
{
	enum { points = 40 }; /* 33 of a row, filled up to whole vectors, which a row of the block has room for */
	const bool eight = (int)PM_SIMD_PART == 8;
	const size_t row = (size_t)pm_block_row[3], plane = row * (size_t)pm_block_rows[3];
	double folded[points * 4] __attribute__((aligned(64))), before[points * 2] __attribute__((aligned(64)));
	for (size_t z = 0; z < cells[2]; z++) {
		memset(before, 0, sizeof before);
		for (size_t y = 0; y <= cells[1]; y++) {
			double *low = t->block + z * plane + y * row;
			double *corners = t->corners + ((z << pm_tile_shift[3][1]) + y) * ((size_t)PM_CORNERS << pm_tile_shift[3][0]);
			if (y == cells[1])
				memset(folded, 0, sizeof folded);
			else if (eight)
				fold_row_by_two(cells[0], corners, folded);
			else
				fold_row(cells[0], corners, folded);
			if (eight)
				add_pairs_by_eight(cells[0] + 1, folded, before, z == 0, low, low + plane);
			else
				add_pairs(cells[0] + 1, folded, before, z == 0, low, low + plane);
		}
	}
}

/* The block of a component to the corners of its cells: column x of four rows is the lower half of cell x and the upper half of cell x-1. */
void pm_tile_cic_unfold(const double *block, const size_t cells[3], double *corners)
{
	const size_t row = (size_t)pm_block_row[3], plane = row * (size_t)pm_block_rows[3];
	double columns[PM_SIMD_WIDTH * 4] __attribute__((aligned(64)));
	for (size_t z = 0; z < cells[2]; z++)
		for (size_t y = 0; y < cells[1]; y++) {
			const double *low = block + z * plane + y * row;
			double *to = corners + (((z << pm_tile_shift[3][1]) + y) << pm_tile_shift[3][0]) * PM_CORNERS;
			for (size_t x = 0; x <= cells[0]; x += PM_SIMD_WIDTH) {
				const double *at = low + x;
				turn_out((const pm_simd[]){pm_simd_load_any(at), pm_simd_load_any(at + plane), pm_simd_load_any(at + row),
					pm_simd_load_any(at + plane + row)}, columns);
				for (size_t l = 0; l < PM_SIMD_WIDTH && x + l <= cells[0]; l++) {
					const pm_simd4_at column = *(const pm_simd4_at *)(columns + turned(l));
					double *cell = to + (x + l) * PM_CORNERS;
					if (x + l < cells[0])
						*(pm_simd4_at *)cell = column;
					if (x + l > 0)
						*(pm_simd4_at *)(cell - 4) = column;
				}
			}
		}
}

/* The eight corners of eight cells to eight vectors, one a corner. */
PM_SIMD_INLINE void turn_corners(const double *corners, const int32_t *at, pm_simd to[8])
{
	PM_SIMD_UNROLL
	for (int half = 0; half < 2; half++) {
		const double *from[PM_SIMD_WIDTH];
		pm_simd v[4];
		PM_SIMD_UNROLL
		for (int l = 0; l < PM_SIMD_WIDTH; l++)
			from[l] = corners + 4 * half + (size_t)(uint32_t)at[l] * PM_CORNERS;
		PM_SIMD_UNROLL
		for (size_t k = 0; k < 4; k++)
			v[k] = pm_simd_fours(from, k);
		pm_simd_turn(v, to + 4 * half);
	}
}

PM_SIMD_INLINE pm_simd_int place_of(const struct eight *e) { return PM_TILE_CIC_CORNERS ? cell_of(e) : node_of(e); }

/* Weights of four rows, [y*2 + z]; x of the two halves of each. */
struct rows {
	pm_simd w[4], x, x0;
	const int32_t *at;
};

PM_SIMD_INLINE struct rows rows_of(const struct places *p, size_t i)
{
	const pm_simd x = pm_simd_load(p->distance[0] + i), y = pm_simd_load(p->distance[1] + i), z = pm_simd_load(p->distance[2] + i), y0 = 1 - y, z0 = 1 - z;
	return (struct rows){.w = {z0 * y0, z * y0, z0 * y, z * y}, .x = x, .x0 = 1 - x, .at = p->at + i};
}

/* The two points of each of four rows of the block. */
PM_SIMD_INLINE void load_rows(const double *block, const int32_t *at, pm_simd to[8])
{
	enum { row = PM_BLOCK_ROW, plane = PM_BLOCK_ROW * PM_BLOCK_ROWS };
	PM_SIMD_UNROLL
	for (size_t some = 0; some < PM_SIMD_WIDTH; some += 4) {
		const double *from[4];
		PM_SIMD_UNROLL
		for (size_t l = 0; l < 4; l++)
			from[l] = block + (size_t)(uint32_t)at[some + l];
		PM_SIMD_UNROLL
		for (size_t k = 0; k < 4; k++) {
			pm_simd4_at pair[2];
			pm_simd4_pairs(from, k / 2 * row + k % 2 * plane, pair);
			memcpy((double *)&to[k] + some, &pair[0], sizeof pair[0]);
			memcpy((double *)&to[k + 4] + some, &pair[1], sizeof pair[1]);
		}
	}
}

/* A component at eight particles: in the order of the loop for all kernels, rows y, then z. from: the corners of its cells, or its block. */
PM_SIMD_INLINE pm_simd value_of(const struct rows *r, const double *from)
{
	pm_simd v[8];
	if (PM_TILE_CIC_CORNERS)
		turn_corners(from, r->at, v);
	else
		load_rows(from, r->at, v);
	/* 0 +: as the loop begins, so that no sum is -0 */
	const pm_simd below = ((0 + v[0] * r->w[0] + v[2] * r->w[2]) + v[1] * r->w[1]) + v[3] * r->w[3];
	const pm_simd above = ((0 + v[4] * r->w[0] + v[6] * r->w[2]) + v[5] * r->w[1]) + v[7] * r->w[3];
	return below * r->x0 + above * r->x;
}

PM_SIMD_INLINE const double *component(const struct pm_tile *t, int c)
{
	return PM_TILE_CIC_CORNERS ? t->corners + (size_t)c * PM_TILE_CELLS * PM_CORNERS : t->block + (size_t)c * PM_BLOCK_MOST;
}

bool pm_tile_cic_gather(const struct pm_tile *t, const struct pm_tile_batch *batch, const struct pm_tile_results *r)
{
	struct delivery to[PM_COMPONENTS];
	struct places places;
	pm_simd nothing = {0};
	for (int c = 0; c < t->components; c++)
		to[c] = delivery_of(r, c);
	for (size_t from = 0, end; from < batch->m; from = end) {
		end = find_places(3, t, batch, from, place_of, &places);
		for (size_t i = from; i < end; i += PM_SIMD_WIDTH) {
			const struct rows rows = rows_of(&places, i - from);
			const size_t n = end - i < PM_SIMD_WIDTH ? end - i : PM_SIMD_WIDTH, p = batch->p + i;
			if (t->components == 1) { /* not in the loop, before which gcc works out the addresses of eight particles and keeps them in memory */
				deliver_eight(value_of(&rows, component(t, 0)), n, &to[0], p, &nothing);
				continue;
			}
			for (int c = 0; c < t->components; c++)
				deliver_eight(value_of(&rows, component(t, c)), n, &to[c], p, &nothing);
		}
	}
	return !pm_simd_outside(nothing, (pm_simd){0}, (pm_simd){0});
}

void pm_tile_cic_gather_eight(const struct pm_tile *t)
{
	const size_t to = (size_t)t->to;
	for (size_t i = 0; i < t->count; i += PM_SIMD_WIDTH) {
		pm_simd fourth;
		const struct eight e = find_eight_of_records(t, i, &fourth);
		struct places places;
		put_eight(3, &e, place_of, 0, &places);
		const struct rows rows = rows_of(&places, 0);
		const size_t n = t->count - i < PM_SIMD_WIDTH ? t->count - i : PM_SIMD_WIDTH;
		if (t->components == 1) {
			const pm_simd v = value_of(&rows, component(t, 0));
			for (size_t l = 0; l < n; l++)
				t->results[(i + l) * to] = v[l];
			continue;
		}
		for (int c = 0; c < t->components; c += 4) {
			const int some = t->components - c < 4 ? t->components - c : 4;
			pm_simd v[4];
			double out[PM_SIMD_WIDTH * 4] __attribute__((aligned(64)));
			PM_SIMD_UNROLL
			for (int k = 0; k < 4; k++)
				v[k] = k < some ? value_of(&rows, component(t, c + k)) : fourth;
			turn_out(v, out);
			for (size_t l = 0; l < n; l++) {
				double *result = t->results + (i + l) * to + c;
				const double *from = out + turned(l);
				if (to == 4 && some > 2) /* the fourth may be written too: nothing else is there */
					*(pm_simd4_at *)result = *(const pm_simd4_at *)from;
				else
					for (int k = 0; k < some; k++)
						result[k] = from[k];
			}
		}
	}
}
