/* Gather of a vector in 3-D: the three (or four) components of a node lie side by side, as four numbers, so that a load is that of a node, of two where a
 * register holds eight, and the weights serve all components; here with cic, wider kernels are in tile-wide.c. Every sum has the order of the loops for all
 * kernels (transfer-tile.c): the same bytes. Cost: width^3 products of four numbers per particle, and two moves per node of the tile.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/tile-eight.h"
#include "transfer/tile-vector.h"
#include "transfer/tile-wide.h"

enum { node_row = PM_NODE_ROW, node_plane = PM_NODE_PLANE };
_Static_assert((int)PM_VECTOR_NODES == 4 * (int)PM_BLOCK_MOST, "four numbers a node");

bool pm_tile_has_vectors(int dim, const struct pm_kernel *k, int components, size_t count)
{
	const bool cic = k->width == 2 && k->degree == 1 && components <= 4;
	const bool wide = ((int)PM_SIMD_PART == 8 || k->width > 4) && pm_tile_gather_woven(k); /* by four lanes, less is as fast by component */
	return PM_TILE_CIC_EIGHT && dim == 3 && components >= 3 && (cic || wide) && count >= PM_TILE_CELLS / 16;
}

void pm_tile_weave(const double *blocks, int components, const size_t slots[3], double *nodes)
{
	for (size_t z = 0; z < slots[2]; z++)
		for (size_t y = 0; y < slots[1]; y++)
			for (size_t x = 0; x < slots[0]; x += PM_SIMD_WIDTH) { /* whole vectors: a row has room, or the next one is written later */
				const double *from = blocks + z * (node_plane / 4) + y * (node_row / 4) + x;
				double *to = nodes + z * node_plane + y * node_row + 4 * x;
				pm_simd v[4];
				PM_SIMD_UNROLL
				for (int c = 0; c < 4; c++)
					v[c] = pm_simd_load_any(from + (size_t)(c < components ? c : 0) * PM_BLOCK_MOST);
				pm_simd_store_columns(to, v);
			}
}

#define LOWER(v) __builtin_shufflevector(v, v, 0, 1, 2, 3)
#define UPPER(v) __builtin_shufflevector(v, v, 4, 5, 6, 7)

PM_SIMD_INLINE void put(const struct pm_tile *t, size_t i, pm_simd4_at value)
{
	double *result = t->results + i * (size_t)t->to;
	if (t->to >= 4) /* of three components the fourth number is nobody's any more (transfer.c, begin_gather) */
		*(pm_simd4_at *)result = value;
	else {
		*(pm_simd2_at *)result = __builtin_shufflevector(value, value, 0, 1);
		result[2] = value[2];
	}
}

pm_tile_loop *pm_tile_gather_vector(const struct pm_kernel *k)
{
	return k->width == 2 ? pm_tile_cic_gather_vectors : pm_tile_gather_woven(k);
}

/* ---- cic, eight particles at a time ---- */

PM_SIMD_INLINE pm_simd4_at value_by_eight(const double *from, const double w[4], double x)
{
	pm_simd8_at rows = 0 + *(const pm_simd8_at *)from * w[0]; /* no sum is -0: see tile-cic.c */
	rows += *(const pm_simd8_at *)(from + node_row) * w[2];
	rows += *(const pm_simd8_at *)(from + node_plane) * w[1];
	rows += *(const pm_simd8_at *)(from + node_plane + node_row) * w[3];
	rows *= pm_simd8_below_above(x);
	return LOWER(rows) + UPPER(rows);
}

PM_SIMD_INLINE pm_simd4_at value_by_four(const double *from, const double w[4], double x)
{
	const pm_simd4_at *row = (const pm_simd4_at *)from, *back = row + node_row / 4, *above = row + node_plane / 4, *both = above + node_row / 4;
	const pm_simd4_at low = ((0 + row[0] * w[0] + back[0] * w[2]) + above[0] * w[1]) + both[0] * w[3];
	const pm_simd4_at high = ((0 + row[1] * w[0] + back[1] * w[2]) + above[1] * w[1]) + both[1] * w[3];
	return low * (1 - x) + high * x;
}

PM_SIMD_INLINE pm_simd_int place_of(const struct eight *e) { return e->cell[2] * node_plane + e->cell[1] * node_row + e->cell[0] * 4; }

PM_SIMD_INLINE void values_of(const struct pm_tile *t, const struct places *p, size_t i, pm_simd4_at value[PM_SIMD_WIDTH])
{
	const pm_simd y = pm_simd_load(p->distance[1] + i), z = pm_simd_load(p->distance[2] + i), y0 = 1 - y, z0 = 1 - z;
	double w[4][PM_SIMD_WIDTH] __attribute__((aligned(64))); /* w[y*2 + z] */
	pm_simd_store(w[0], z0 * y0), pm_simd_store(w[1], z * y0), pm_simd_store(w[2], z0 * y), pm_simd_store(w[3], z * y);
	PM_SIMD_UNROLL
	for (size_t l = 0; l < PM_SIMD_WIDTH; l++) {
		const double *from = t->nodes + (size_t)(uint32_t)p->at[i + l], x = p->distance[0][i + l];
		const double f[4] = {w[0][l], w[1][l], w[2][l], w[3][l]};
		value[l] = (int)PM_SIMD_PART == 8 ? value_by_eight(from, f, x) : value_by_four(from, f, x);
	}
}

void pm_tile_cic_gather_vectors(const struct pm_tile *t)
{
	for (size_t i = 0; i < t->count; i += PM_SIMD_WIDTH) {
		pm_simd fourth;
		pm_simd4_at value[PM_SIMD_WIDTH];
		struct places places;
		const struct eight e = find_eight_of_records(t, i, &fourth);
		put_eight(3, &e, place_of, 0, &places);
		values_of(t, &places, 0, value);
		for (size_t l = 0; l < PM_SIMD_WIDTH && i + l < t->count; l++)
			put(t, i + l, value[l]);
	}
}

/* Of three components with one factor the squares, for the largest. */
PM_SIMD_INLINE void look_at(const pm_simd component[4], const struct delivery to[4], pm_simd *most)
{
	pm_simd square = {0};
	PM_SIMD_UNROLL
	for (int c = 0; c < 3; c++)
		square = square + to[c].times * component[c] * (to[c].times * component[c]);
	pm_simd_raise(most, square);
}

/* Those of places, the first of them number p. most: NULL, or raised. */
PM_SIMD_INLINE void deliver_places(const struct pm_tile *t, const struct places *places, size_t many, const struct delivery to[4], size_t p, pm_simd *most,
	pm_simd *nothing)
{
	for (size_t i = 0; i < many; i += PM_SIMD_WIDTH) {
		const size_t n = many - i < PM_SIMD_WIDTH ? many - i : PM_SIMD_WIDTH;
		pm_simd4_at value[PM_SIMD_WIDTH];
		pm_simd component[4];
		values_of(t, places, i, value);
		pm_simd_rows_to_lanes(value, component);
		if (most)
			look_at(component, to, most);
		PM_SIMD_UNROLL
		for (int c = 0; c < 4; c++)
			if (c < t->components)
				deliver_eight(component[c], n, &to[c], p + i, nothing);
	}
}

bool pm_tile_cic_gather_vectors_in_order(const struct pm_tile *t, const struct pm_tile_batch *batch, const struct pm_tile_results *r)
{
	struct delivery to[4];
	struct places places;
	pm_simd nothing = {0}, most = {0};
	for (int c = 0; c < t->components; c++)
		to[c] = delivery_of(r, c);
	for (size_t from = 0, end; from < batch->m; from = end) {
		end = find_places(3, t, batch, from, place_of, &places);
		deliver_places(t, &places, end - from, to, batch->p + from, r->most ? &most : NULL, &nothing);
	}
	for (int l = 0; l < PM_SIMD_WIDTH && r->most; l++)
		*r->most = most[l] > *r->most ? most[l] : *r->most;
	return !pm_simd_outside(nothing, (pm_simd){0}, (pm_simd){0});
}

/* Cells of the mesh to those of the block; as bits those beyond it, which are put into its first one. */
PM_SIMD_INLINE unsigned in_reach(const struct pm_tile_reach *reach, struct eight *e)
{
	pm_simd_int beyond = {0};
	PM_SIMD_UNROLL
	for (int d = 0; d < 3; d++) {
		pm_simd_int c = e->cell[d] - reach->first[d];
		c += (c < 0) & reach->cells[d];
		beyond |= c >= reach->many[d];
		e->cell[d] = c;
	}
	PM_SIMD_UNROLL
	for (int d = 0; d < 3; d++)
		e->cell[d] &= ~beyond;
	return pm_simd_int_others(beyond, 0);
}

void pm_tile_cic_gather_vectors_near(const struct pm_tile *t, const struct pm_tile_batch *batch, const struct pm_tile_reach *reach,
	const struct pm_tile_results *r, uint64_t beyond[PM_TILE_ORDER_PACK / 64])
{
	const struct pm_tile_batch mine = *batch;
	struct delivery to[4];
	struct places places;
	pm_simd nothing = {0};
	for (int c = 0; c < t->components; c++)
		to[c] = delivery_of(r, c);
	for (size_t k = 0; k < PM_TILE_ORDER_PACK / 64; k++)
		beyond[k] = 0;
	for (size_t i = 0; i < mine.m; i += PM_SIMD_WIDTH) {
		struct eight e = find_eight_of(3, t, &mine, i);
		const size_t n = mine.m - i < PM_SIMD_WIDTH ? mine.m - i : PM_SIMD_WIDTH;
		beyond[i / 64] |= (uint64_t)(in_reach(reach, &e) & ((1u << n) - 1)) << i % 64;
		put_eight(3, &e, place_of, i, &places);
	}
	deliver_places(t, &places, mine.m, to, mine.p, NULL, &nothing);
}
