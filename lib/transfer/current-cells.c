/* Esirkepov's current in 3-D of ways whose ends have the same points, for cic and tsc: most ways in a step that Courant's condition limits. Each is
 * 3 (width - 1) width^2 numbers of its cell, those of current-tile.c: q p_x(i) [A_y A_z + D_y D_z/12] for every i, y and z, and likewise along y and z. They
 * are found for four particles at once, turned, added to the sums of the cells, and these to the mesh once a job. The other ways are left to current-tile.c.
 * Source: Esirkepov 2001; sums of cells as in VPIC, Bowers et al. 2008, Physics of Plasmas 15, 055703. Cost: as many numbers, a quarter of an operation each.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/current-cells.h"
#include "transfer/tile-by-axis.h"

int pm_current_cells_new(struct pm_current_cells **to, int threads, int dim, const struct pm_kernel *k)
{
	const size_t each = PM_TILE_CELLS * pm_current_cell_values(dim, k);
	*to = each ? pm_zalloc((size_t)threads, sizeof **to) : NULL;
	if (!each)
		return 0;
	double *sums = *to ? pm_zalloc((size_t)threads * each, sizeof *sums) : NULL;
	if (!sums) {
		*to = pm_free(*to);
		return -PM_DATA;
	}
	for (int i = 0; i < threads; i++)
		(*to)[i].kernel = k, (*to)[i].sums = sums + (size_t)i * each;
	return 0;
}

struct pm_current_cells *pm_current_cells_free(struct pm_current_cells *t)
{
	if (t)
		pm_free(t->sums);
	return pm_free(t);
}

enum { width_most = 3, values_most = 56, fours = 4, row_cells = 32, rows = 16 };
_Static_assert((int)PM_CURRENT_CELL_ROWS == (int)PM_TILE_CELLS / (int)row_cells, "");

typedef pm_by_axis four; /* of four particles */
typedef int32_t four_int __attribute__((vector_size(fours * sizeof(int32_t))));

/* Along an axis, of four particles: mean and change of the weights, and the charge passed from each point to the next. */
struct along {
	four mean[width_most], change[width_most], passed[width_most];
};

/* `same`: which have both ends between the same points. */
PM_SIMD_INLINE four_int find_along(int width, const struct pm_current_cells *t, int d, size_t i, struct along *a, pm_mask_by_axis *same)
{
	const four u = *(const pm_simd4_at *)(t->u[d] + i), way = *(const pm_simd4_at *)(t->way[d] + i), to = u + where(way < 0, -way, way);
	pm_simd4_int_at cell, end;
	four low[width_most], high[width_most], sum = {0};
	const four from = pm_simd4_split(u, &cell), rest = pm_simd4_split(to, &end); /* u >= 0 */
	find_by_axis(t->kernel, width, width - 1, from - t->shift, low);
	find_by_axis(t->kernel, width, width - 1, rest - t->shift, high);
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++) {
		const four difference = high[k] - low[k];
		a->mean[k] = 0.5 * (low[k] + high[k]);
		a->change[k] = where(way < 0, -difference, difference);
		sum -= a->change[k];
		a->passed[k] = sum;
	}
	*same &= __builtin_convertvector(cell == end, pm_mask_by_axis);
	return cell - (int32_t)t->cell[d];
}

/* The numbers of the current along an axis: [along it][second other][first other]. */
PM_SIMD_INLINE void find_values(int width, four q, const struct along *on, const struct along *first, const struct along *second, four *value)
{
	four across[width_most * width_most];
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++) {
		const four change = second->change[k] * (1. / 12);
		PM_SIMD_UNROLL
		for (int j = 0; j < width; j++)
			across[k * width + j] = first->mean[j] * second->mean[k] + first->change[j] * change;
	}
	PM_SIMD_UNROLL
	for (int i = 0; i < width - 1; i++) {
		const four passed = q * on->passed[i];
		PM_SIMD_UNROLL
		for (int k = 0; k < width * width; k++)
			value[i * width * width + k] = passed * across[k];
	}
}

/* Four rows of four numbers of particles to the sums of their cells; in one cell they are added up first, because sums at one place wait for each other. */
PM_SIMD_INLINE void to_sums(double *const sums[fours], bool one, int k, four *value)
{
	turn_rows(value);
	if (one)
		*(pm_simd4_at *)(sums[0] + k) += (value[0] + value[1]) + (value[2] + value[3]);
	else
		PM_SIMD_UNROLL
		for (int l = 0; l < fours; l++)
			*(pm_simd4_at *)(sums[l] + k) += value[l];
}

PM_SIMD_INLINE size_t add(int width, struct pm_current_cells *t, uint32_t *others)
{
	const int n = 3 * (width - 1) * width * width, each = (n + fours - 1) / fours * fours;
	size_t left = 0;
	for (size_t i = t->count; i % fours; i++) { /* four at a time: further ones without charge */
		for (int d = 0; d < 3; d++)
			t->u[d][i] = t->u[d][i - 1], t->way[d][i] = 0;
		t->q[i] = 0;
	}
	for (size_t i = 0; i < t->count; i += fours) {
		struct along x, y, z;
		four value[values_most];
		pm_mask_by_axis same = {-1, -1, -1, -1};
		four_int at = find_along(width, t, 0, i, &x, &same);
		at += find_along(width, t, 1, i, &y, &same) * row_cells;
		at += find_along(width, t, 2, i, &z, &same) * (row_cells * rows);
		const four q = (four)((pm_mask_by_axis) * (const pm_simd4_at *)(t->q + i) & same);
		double *sums[fours];
		PM_SIMD_UNROLL
		for (int l = 0; l < fours; l++) {
			others[left] = (uint32_t)i + (uint32_t)l;
			left += (size_t)(same[l] + 1);
			t->used[at[l] / row_cells] = 1;
			sums[l] = t->sums + at[l] * each;
		}
		find_values(width, q, &x, &y, &z, value);
		find_values(width, q, &y, &x, &z, value + n / 3);
		find_values(width, q, &z, &x, &y, value + 2 * n / 3);
		for (int k = n; k < each; k++)
			value[k] = all_axes(0);
		if (sums[0] == sums[1] && sums[0] == sums[2] && sums[0] == sums[3])
			for (int k = 0; k < each; k += fours)
				to_sums(sums, true, k, value + k);
		else
			for (int k = 0; k < each; k += fours)
				to_sums(sums, false, k, value + k);
	}
	return left;
}

size_t pm_current_cells_add(struct pm_current_cells *t, uint32_t others[PM_TILE_ORDER_PACK])
{
	return t->kernel->width == 2 ? add(2, t, others) : add(3, t, others);
}

PM_SIMD_INLINE void fold(int width, struct pm_current_cells *t, double *const block[3])
{
	const int step[3] = {1, pm_block_row[3], pm_block_row[3] * pm_block_rows[3]}, each = (3 * (width - 1) * width * width + fours - 1) / fours * fours;
	for (int r = 0; r < PM_CURRENT_CELL_ROWS; r++) {
		if (!t->used[r])
			continue;
		double *sums = t->sums + (size_t)r * row_cells * (size_t)each;
		const int at = r / rows * step[2] + r % rows * step[1];
		for (int c = 0, e = 0; c < 3; c++)
			for (int i = 0; i < width - 1; i++)
				for (int k = 0; k < width; k++)
					for (int j = 0; j < width; j++, e++) {
						double *to = block[c] + at + i * step[c] + j * step[c == 0 ? 1 : 0] + k * step[c == 2 ? 1 : 2];
						for (int x = 0; x < row_cells; x++)
							to[x] += sums[x * each + e];
					}
		memset(sums, 0, (size_t)(row_cells * each) * sizeof *sums);
		t->used[r] = 0;
	}
}

void pm_current_cells_fold(struct pm_current_cells *t, double *const block[3])
{
	if (t->kernel->width == 2)
		fold(2, t, block);
	else
		fold(3, t, block);
}
