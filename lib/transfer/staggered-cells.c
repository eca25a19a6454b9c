/* Gather of E and B of Yee's mesh by cic one order lower, in space, where a tile has many particles: E along an axis is linear across it and the same along
 * it, B the other way round, so that a particle needs 18 numbers of its cell alone, which stand in a row. Four particles at once. As VPIC's interpolators,
 * Bowers et al. 2008, Physics of Plasmas 15, 055703. The sums are those of staggered-tile.c, to the last bit.
 * Cost: five rows of four numbers a particle, and 18 numbers a cell of the tile. SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/staggered-nodes.h"
#include "transfer/tile-by-axis.h"

enum { fours = 4, numbers = 20 };
_Static_assert((int)numbers * (int)PM_TILE_CELLS <= (int)PM_STAGGERED_NODES, "");
typedef pm_by_axis four; /* of four particles */
typedef int32_t four_int __attribute__((vector_size(fours * sizeof(int32_t))));

void pm_staggered_fill_cells(const double *blocks, const size_t slots[3], double *cells)
{
	const size_t y_up = (size_t)pm_block_row[3], z_up = y_up * (size_t)pm_block_rows[3], b = PM_BLOCK_MOST;
	const int *shift = pm_tile_shift[3];
	for (size_t z = 0; z + 1 < slots[2] && !(z >> shift[2]); z++)
		for (size_t y = 0; y + 1 < slots[1] && !(y >> shift[1]); y++)
			for (size_t x = 0; x + 1 < slots[0] && !(x >> shift[0]); x++) {
				const double *e = blocks + z * z_up + y * y_up + x;
				double *to = cells + ((((z << shift[1]) + y) << shift[0]) + x) * numbers;
				const double row[numbers] = {e[0], e[y_up], e[z_up], e[z_up + y_up], e[b], e[b + 1], e[b + z_up], e[b + z_up + 1],
					e[2 * b], e[2 * b + 1], e[2 * b + y_up], e[2 * b + y_up + 1], e[3 * b], e[3 * b + 1], e[4 * b], e[4 * b + y_up],
					e[5 * b], e[5 * b + z_up]};
				for (int i = 0; i < numbers; i++)
					to[i] = row[i];
			}
}

/* Linear in an axis, of which u is the part of a cell: begins with 0, because a sum of nothing but -0 is 0. */
PM_SIMD_INLINE four linear(four a, four b, four below, four u) { return 0 + a * below + b * u; }

/* Where the numbers of the particles' cells begin. */
static void find_cells(const struct pm_staggered_tile *t, int32_t *at)
{
	const int *shift = pm_tile_shift[3];
	for (size_t i = 0; i < t->count; i += fours) {
		four_int sum = {0};
		for (int d = 0; d < 3; d++) {
			pm_simd4_int_at cell;
			pm_simd4_split(*(const pm_simd4_at *)(t->u[d] + i), &cell); /* u >= 0 */
			sum += (cell - (int32_t)t->cell[d]) * (numbers << (d > 0 ? shift[0] : 0) << (d > 1 ? shift[1] : 0));
		}
		*(pm_simd4_int_at *)(at + i) = sum;
	}
}

void pm_staggered_gather_cells(const struct pm_staggered_tile *t)
{
	double *const results = t->results;
	int32_t at[PM_TILE_ORDER_PACK];
	find_cells(t, at); /* not in the next loop: four particles would wait for their addresses, at two thirds of the speed */
	for (size_t i = 0; i < t->count; i += fours) {
		four part[3], below[3], n[numbers];
		for (int d = 0; d < 3; d++) {
			pm_simd4_int_at cell;
			part[d] = (four)pm_simd4_split(*(const pm_simd4_at *)(t->u[d] + i), &cell);
			below[d] = 1 - part[d];
		}
		const size_t last = t->count - i - 1;
		for (int l = 0; l < fours; l++) { /* the last one again where there are fewer */
			const double *row = t->nodes + at[i + ((size_t)l < last ? (size_t)l : last)];
			for (int k = 0; k < numbers; k += fours)
				n[k + l] = *(const pm_simd4_at *)(row + k);
		}
		for (int k = 0; k < numbers; k += fours)
			turn_rows(n + k);
		const four zero = {0}, value[6] = {
			zero + (below[2] * below[1] * n[0] + below[2] * part[1] * n[1] + part[2] * below[1] * n[2] + part[2] * part[1] * n[3]),
			linear(below[2] * n[4] + part[2] * n[6], below[2] * n[5] + part[2] * n[7], below[0], part[0]),
			linear(below[1] * n[8] + part[1] * n[10], below[1] * n[9] + part[1] * n[11], below[0], part[0]),
			linear(n[12], n[13], below[0], part[0]), linear(n[14], n[15], below[1], part[1]), linear(n[16], n[17], below[2], part[2])};
		for (int c = 0; c < 6; c++)
			*(pm_simd4_at *)(results + c * PM_TILE_ORDER_PACK + i) = value[c];
	}
}
