/* Esirkepov's current of ways whose ends have the same points, for cic and tsc, on a line pcs too: most ways in a step that Courant's condition
 * limits. Each is a few numbers of its cell, those of current-tile.c: along x q p_x(i) [A_y A_z + D_y D_z/12] for every i, y and z, and likewise
 * along y and z. They are found for four particles at once, turned, added to the sums of the cells, and these to the mesh once a job. The other ways are left
 * to current-tile.c. Source: Esirkepov 2001; sums of cells as in VPIC, Bowers et al. 2008, Physics of Plasmas 15, 055703. Cost: as many numbers, a quarter of
 * an operation each. SPDX-License-Identifier: GPL-3.0-or-later */
#include "current/current-cells.h"
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
		(*to)[i].dim = dim, (*to)[i].kernel = k, (*to)[i].sums = sums + (size_t)i * each;
	return 0;
}

struct pm_current_cells *pm_current_cells_free(struct pm_current_cells *t)
{
	if (t)
		pm_free(t->sums);
	return pm_free(t);
}

enum { width_most = 4, values_most = 56, fours = 4, piece = 32 };
_Static_assert((int)PM_CURRENT_CELL_ROWS == (int)PM_TILE_CELLS / (int)piece, "");

typedef pm_by_axis four; /* of four particles */
typedef int32_t four_int __attribute__((vector_size(fours * sizeof(int32_t))));

/* Along an axis, of four particles: mean and change of the weights, and the charge passed from each point to the next. */
struct along {
	four mean[width_most], change[width_most], passed[width_most];
};

/* The other axes of a component, where they are below dim. */
PM_SIMD_INLINE int first_other(int c) { return c == 0 ? 1 : 0; }
PM_SIMD_INLINE int second_other(int c) { return c == 2 ? 1 : 2; }

/* `same`: which have both ends between the same points. */
PM_SIMD_INLINE four_int find_along(int width, const struct pm_current_cells *t, int d, size_t i, struct along *a, pm_mask_by_axis *same)
{
	const four way = *(const pm_simd4_at *)(t->way[d] + i);
	pm_simd4_int_at cell;
	four from[width_most], to[width_most], sum = {0};
	const four begins = pm_simd4_split(*(const pm_simd4_at *)(t->u[d] + i), &cell), ends = begins + way; /* u >= 0 */
	find_by_axis(t->kernel, width, width - 1, begins - t->shift, from);
	find_by_axis(t->kernel, width, width - 1, ends - t->shift, to);
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++) {
		a->mean[k] = 0.5 * (from[k] + to[k]);
		a->change[k] = to[k] - from[k];
		sum -= a->change[k];
		a->passed[k] = sum;
	}
	*same &= (ends >= 0) & (ends < 1);
	return cell - (int32_t)t->cell[d];
}

/* The numbers of component c, of a charge q (from dim on of what it carries): [along it][second other][first other]; returns how many. */
PM_SIMD_INLINE int find_values(int dim, int width, int c, four q, const struct along *axes, four *value)
{
	const int first = first_other(c), second = second_other(c), nj = first < dim ? width : 1, nk = second < dim ? width : 1;
	const int n = nj * nk, steps = c < dim ? width - 1 : 1;
	four across[width_most * width_most];
	PM_SIMD_UNROLL
	for (int k = 0; k < nk; k++) {
		const four change = nk > 1 ? axes[second].change[k] * (1. / 12) : all_axes(0);
		PM_SIMD_UNROLL
		for (int j = 0; j < nj; j++)
			across[k * nj + j] = nk > 1 ? axes[first].mean[j] * axes[second].mean[k] + axes[first].change[j] * change :
				nj > 1 ? axes[first].mean[j] : all_axes(1);
	}
	PM_SIMD_UNROLL
	for (int i = 0; i < steps; i++) {
		const four passed = c < dim ? q * axes[c].passed[i] : q;
		PM_SIMD_UNROLL
		for (int k = 0; k < n; k++)
			value[i * n + k] = passed * across[k];
	}
	return steps * n;
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

/* Four at a time: further ones without charge. */
static void fill_up(struct pm_current_cells *t)
{
	for (size_t i = t->count; i % fours; i++) {
		for (int d = 0; d < t->dim; d++)
			t->u[d][i] = t->u[d][i - 1], t->way[d][i] = 0;
		for (int d = t->dim; d < 3; d++)
			t->along[d - t->dim][i] = 0;
		t->q[i] = 0;
	}
}

PM_SIMD_INLINE four masked(const double *from, pm_mask_by_axis on) { return (four)((pm_mask_by_axis) * (const pm_simd4_at *)from & on); }

PM_SIMD_INLINE size_t add(int dim, int width, struct pm_current_cells *t, uint32_t *others)
{
	const int each = (pm_current_cell_numbers(dim, width) + fours - 1) / fours * fours, *shift = pm_tile_shift[dim];
	size_t left = 0;
	fill_up(t);
	for (size_t i = 0; i < t->count; i += fours) {
		struct along axes[3];
		four value[values_most];
		pm_mask_by_axis same = {-1, -1, -1, -1};
		four_int at = find_along(width, t, 0, i, &axes[0], &same);
		if (dim > 1)
			at += find_along(width, t, 1, i, &axes[1], &same) << shift[0];
		if (dim > 2)
			at += find_along(width, t, 2, i, &axes[2], &same) << (shift[0] + shift[1]);
		double *sums[fours];
		PM_SIMD_UNROLL
		for (int l = 0; l < fours; l++) {
			others[left] = (uint32_t)i + (uint32_t)l;
			left += (size_t)(same[l] + 1);
			t->used[at[l] / piece] = 1;
			sums[l] = t->sums + at[l] * each;
		}
		int n = find_values(dim, width, 0, masked(t->q + i, same), axes, value); /* one by one: constants when their loops are unrolled */
		n += find_values(dim, width, 1, masked((dim > 1 ? t->q : t->along[0]) + i, same), axes, value + n);
		n += find_values(dim, width, 2, masked((dim > 2 ? t->q : t->along[2 - dim]) + i, same), axes, value + n);
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

/* From the sums of a piece of a row to the blocks. */
PM_SIMD_INLINE void fold_piece(int dim, int width, double *sums, int at, double *const block[3])
{
	const int step[3] = {1, pm_block_row[dim], pm_block_row[dim] * pm_block_rows[dim]};
	const int each = (pm_current_cell_numbers(dim, width) + fours - 1) / fours * fours;
	for (int c = 0, e = 0; c < 3; c++) {
		const int first = first_other(c), second = second_other(c);
		for (int i = 0; i < (c < dim ? width - 1 : 1); i++)
			for (int k = 0; k < (second < dim ? width : 1); k++)
				for (int j = 0; j < (first < dim ? width : 1); j++, e++) {
					double *to = block[c] + at + (c < dim ? i * step[c] : 0) + (first < dim ? j * step[first] : 0) +
						(second < dim ? k * step[second] : 0);
					for (int x = 0; x < piece; x++)
						to[x] += sums[x * each + e];
				}
	}
	memset(sums, 0, (size_t)(piece * each) * sizeof *sums);
}

PM_SIMD_INLINE void fold(int dim, int width, struct pm_current_cells *t, double *const block[3])
{
	const int *shift = pm_tile_shift[dim], row = pm_block_row[dim], plane = row * pm_block_rows[dim];
	const int first = 1 + (dim > 1 ? row : 0) + (dim > 2 ? plane : 0); /* a slot below the tile on every axis */
	const size_t each = (size_t)(pm_current_cell_numbers(dim, width) + fours - 1) / fours * fours;
	for (int r = 0; r < PM_CURRENT_CELL_ROWS; r++) {
		const int cell = r * piece, x = cell & ((1 << shift[0]) - 1), y = cell >> shift[0] & ((1 << shift[1]) - 1), z = cell >> shift[0] >> shift[1];
		if (t->used[r])
			fold_piece(dim, width, t->sums + (size_t)cell * each, first + z * plane + y * row + x, block);
		t->used[r] = 0;
	}
}

#define ADD(dim, width) static size_t add_##dim##_##width(struct pm_current_cells *t, uint32_t *others) { return add(dim, width, t, others); }
#define FOLD(dim, width) static void fold_##dim##_##width(struct pm_current_cells *t, double *const block[3]) { fold(dim, width, t, block); }
#define EVERY(WHAT) WHAT(1, 2) WHAT(1, 3) WHAT(1, 4) WHAT(2, 2) WHAT(2, 3) WHAT(3, 2) WHAT(3, 3)
EVERY(ADD)
EVERY(FOLD)
#define ROWS(what) {{what##_1_2, what##_1_3, what##_1_4}, {what##_2_2, what##_2_3, NULL}, {what##_3_2, what##_3_3, NULL}}
static size_t (*const adds[3][3])(struct pm_current_cells *t, uint32_t *others) = ROWS(add);
static void (*const folds[3][3])(struct pm_current_cells *t, double *const block[3]) = ROWS(fold);

size_t pm_current_cells_add(struct pm_current_cells *t, uint32_t others[PM_TILE_ORDER_PACK]) { return adds[t->dim - 1][t->kernel->width - 2](t, others); }

void pm_current_cells_fold(struct pm_current_cells *t, double *const block[3]) { folds[t->dim - 1][t->kernel->width - 2](t, block); }
