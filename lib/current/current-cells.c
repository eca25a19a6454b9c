/* Esirkepov's current of ways whose ends have the same points, for cic and tsc, on a line pcs too: most ways in a step that Courant's condition limits.
 * Each is a few numbers of its cell, those of current-tile.c: along x q p_x(i) [A_y A_z + D_y D_z/12] for every i, y and z, and likewise along y and z.
 * They are found for four particles at once, turned, added to the sums of the cells, and these to the mesh once a job. Ways that leave their points on one
 * axis are such numbers of two cells. The other ways, on more than one axis or out of the tile, are left to current-tile.c. Source: Esirkepov 2001; sums of
 * cells as in VPIC, Bowers et al. 2008, Physics of Plasmas 15, 055703. Cost: as many numbers, a quarter of an operation each.
 * SPDX-License-Identifier: GPL-3.0-or-later */
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

enum { width_most = 4, values_most = 56, fours = 4, piece = 32, nothing = PM_TILE_ORDER_PACK };
_Static_assert((int)PM_CURRENT_CELL_ROWS == (int)PM_TILE_CELLS / (int)piece, "");

typedef pm_by_axis four; /* of four particles */
typedef int32_t four_int __attribute__((vector_size(fours * sizeof(int32_t))));

/* Along an axis, of four particles: mean and change of the weights, and the charge passed from each point to the next. */
struct along {
	four mean[width_most + 1], change[width_most + 1], passed[width_most + 1];
};

/* The other axes of a component, where they are below dim. */
PM_SIMD_INLINE int first_other(int c) { return c == 0 ? 1 : 0; }
PM_SIMD_INLINE int second_other(int c) { return c == 2 ? 1 : 2; }

/* Of ways from u on; leaves: to the next cell below or above, with one point more than the kernel has. `same`: which have both ends between the same points.
 * Returns the cell of the first point, from the tile's on. */
PM_SIMD_INLINE four_int find_along(int width, bool leaves, const struct pm_current_cells *t, int d, four u, four way, struct along *a, pm_mask_by_axis *same)
{
	pm_simd4_int_at cell;
	four from[width_most], to[width_most], sum = {0};
	const four begins = pm_simd4_split(u, &cell), ends = begins + way; /* u >= 0 */
	const double shift = width % 2 ? 0.5 : 0; /* of transfer-axis.h: a constant */
	const pm_mask_by_axis below = ends < 0;
	find_by_axis(t->kernel, width, width - 1, begins - shift, from);
	find_by_axis(t->kernel, width, width - 1, leaves ? ends - shift + where(below, all_axes(1), all_axes(-1)) : ends - shift, to);
	PM_SIMD_UNROLL
	for (int k = 0; k < width + leaves; k++) {
		const four first = k < width ? from[k] : all_axes(0), last = k < width ? to[k] : all_axes(0);
		const four here = leaves ? where(below, k ? from[k - 1] : all_axes(0), first) : first;
		const four there = leaves ? where(below, last, k ? to[k - 1] : all_axes(0)) : last;
		a->mean[k] = 0.5 * (here + there);
		a->change[k] = there - here;
		sum -= a->change[k];
		a->passed[k] = sum;
	}
	*same &= ~below & (ends < 1);
	const four_int first = cell - (int32_t)t->cell[d];
	return leaves ? first + __builtin_convertvector(below, four_int) : first;
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
PM_SIMD_INLINE void to_sums(double *const sums[fours], bool one, size_t k, four *value)
{
	turn_rows(value);
	if (one)
		*(pm_simd4_at *)(sums[0] + k) += (value[0] + value[1]) + (value[2] + value[3]);
	else
		PM_SIMD_UNROLL
		for (int l = 0; l < fours; l++)
			*(pm_simd4_at *)(sums[l] + k) += value[l];
}

static void put(struct pm_current_cells *t, size_t i, int d, double u)
{
	if (d < t->dim)
		t->u[d][i] = u, t->way[d][i] = 0;
	else
		t->along[d - t->dim][i] = 0;
	t->q[i] = 0;
}

/* Four at a time: further ones without charge. Number `nothing` is in the first cell, which has a next one. */
static void fill_up(struct pm_current_cells *t)
{
	for (int d = 0; d < 3; d++) {
		for (size_t i = t->count; i % fours; i++)
			put(t, i, d, t->u[d][i - 1]);
		put(t, nothing, d, (double)t->cell[d]);
	}
}

/* Of the number of a cell in the tile, below those of an axis. */
PM_SIMD_INLINE int bits_below(int dim, int d) { return (d > 0 ? pm_tile_shift[dim][0] : 0) + (d > 1 ? pm_tile_shift[dim][1] : 0); }

/* The numbers of four ways to the sums of these cells; q: the charge, and from dim on what it carries. */
PM_SIMD_INLINE void to_cells(int dim, int width, struct pm_current_cells *t, four_int at, const four q[3], const struct along *axes)
{
	const size_t each = (size_t)(pm_current_cell_numbers(dim, width) + fours - 1) / fours * fours;
	four value[values_most];
	double *sums[fours];
	PM_SIMD_UNROLL
	for (int l = 0; l < fours; l++) {
		const size_t cell = (uint32_t)at[l]; /* unsigned: half the instructions */
		t->used[cell / piece] = 1;
		sums[l] = t->sums + cell * each;
	}
	int n = find_values(dim, width, 0, q[0], axes, value); /* one by one: constants when their loops are unrolled */
	n += find_values(dim, width, 1, q[1], axes, value + n);
	n += find_values(dim, width, 2, q[2], axes, value + n);
	for (size_t k = (size_t)n; k < each; k++)
		value[k] = all_axes(0);
	if (sums[0] == sums[1] && sums[0] == sums[2] && sums[0] == sums[3])
		for (size_t k = 0; k < each; k += fours)
			to_sums(sums, true, k, value + k);
	else
		for (size_t k = 0; k < each; k += fours)
			to_sums(sums, false, k, value + k);
}

PM_SIMD_INLINE four masked(const double *from, pm_mask_by_axis on) { return (four)((pm_mask_by_axis) * (const pm_simd4_at *)from & on); }

/* Of four from i on those whose bits are set, to the others; how many these are then. Without a branch, which could not be foreseen. */
PM_SIMD_INLINE size_t keep_others(uint32_t i, unsigned bits, uint32_t *others, size_t left)
{
	static const struct {
		unsigned char lane[fours], many;
	} of[1 << fours] = {{{0}, 0}, {{0}, 1}, {{1}, 1}, {{0, 1}, 2}, {{2}, 1}, {{0, 2}, 2}, {{1, 2}, 2}, {{0, 1, 2}, 3}, {{3}, 1}, {{0, 3}, 2}, {{1, 3}, 2},
		{{0, 1, 3}, 3}, {{2, 3}, 2}, {{0, 2, 3}, 3}, {{1, 2, 3}, 3}, {{0, 1, 2, 3}, 4}};
	PM_SIMD_UNROLL
	for (int l = 0; l < fours; l++)
		others[left + (size_t)l] = i + of[bits].lane[l];
	return left + of[bits].many;
}

PM_SIMD_INLINE size_t add_within(int dim, int width, struct pm_current_cells *t, uint32_t *others)
{
	size_t left = 0;
	fill_up(t);
	for (size_t i = 0; i < t->count; i += fours) {
		struct along axes[3];
		four q[3];
		pm_mask_by_axis same = {-1, -1, -1, -1};
		four_int at = {0};
		PM_SIMD_UNROLL
		for (int d = 0; d < dim; d++) {
			const four u = *(const pm_simd4_at *)(t->u[d] + i), way = *(const pm_simd4_at *)(t->way[d] + i);
			at += find_along(width, false, t, d, u, way, &axes[d], &same) << bits_below(dim, d);
		}
		left = keep_others((uint32_t)i, ~pm_simd4_bits((four)same) & 15, others, left);
		for (int c = 0; c < 3; c++)
			q[c] = masked((c < dim ? t->q : t->along[c - dim]) + i, same);
		to_cells(dim, width, t, at, q, axes);
	}
	return left;
}

/* ---- ways that leave their points on one axis ---- */

/* By axis; room for `nothing` in the last four, and for a fourth list that has none. */
struct leaving {
	uint32_t number[4][PM_TILE_ORDER_PACK + fours];
	size_t count[4];
};

PM_SIMD_INLINE four four_of(const double *from, const uint32_t *i) { return (four){from[i[0]], from[i[1]], from[i[2]], from[i[3]]}; }

/* Takes those out of `others` that end in the next cell on one axis, within the tile; how many are left. */
PM_SIMD_INLINE size_t find_leaving(int dim, const struct pm_current_cells *t, uint32_t *others, size_t n, struct leaving *to)
{
	size_t left = 0, filled = n;
	for (; filled % fours; filled++)
		others[filled] = nothing;
	for (size_t k = 0; k < filled; k += fours) {
		four_int axis = {0}, axes = {0}, outside = {0};
		PM_SIMD_UNROLL
		for (int d = 0; d < dim; d++) {
			pm_simd4_int_at cell;
			const four ends = pm_simd4_split(four_of(t->u[d], others + k), &cell) + four_of(t->way[d], others + k);
			const four_int side = __builtin_convertvector(ends < 0, four_int) - __builtin_convertvector(ends >= 1, four_int), moved = side != 0;
			axis += moved & d;
			axes -= moved;
			outside |= (cell - (int32_t)t->cell[d] + side) >> pm_tile_shift[dim][d];
		}
		const four_int one = (axes == 1) & (outside == 0);
		for (int l = 0; l < fours; l++) {
			const uint32_t i = others[k + (size_t)l];
			to->number[axis[l]][to->count[axis[l]]] = i, to->count[axis[l]] += (size_t)-one[l];
			others[left] = i, left += (size_t)(one[l] + 1);
		}
	}
	return left - (filled - n); /* they come last */
}

/* The last point of axis d alone: the others are those of the cell before. */
PM_SIMD_INLINE void keep_last(int width, struct along *a)
{
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++) {
		a->mean[k] = k == width - 1 ? a->mean[width] : all_axes(0);
		a->change[k] = k == width - 1 ? a->change[width] : all_axes(0);
		a->passed[k] = k == width - 2 ? a->passed[width - 1] : all_axes(0);
	}
}

PM_SIMD_INLINE void add_leaving(int dim, int width, int d, struct pm_current_cells *t, struct leaving *list)
{
	for (size_t k = list->count[d]; k % fours; k++)
		list->number[d][k] = nothing;
	for (size_t k = 0; k < list->count[d]; k += fours) {
		struct along axes[3];
		four q[3];
		const uint32_t *i = list->number[d] + k;
		pm_mask_by_axis same = {0};
		four_int at = {0};
		PM_SIMD_UNROLL
		for (int e = 0; e < dim; e++)
			at += find_along(width, e == d, t, e, four_of(t->u[e], i), four_of(t->way[e], i), &axes[e], &same) << bits_below(dim, e);
		for (int c = 0; c < 3; c++)
			q[c] = four_of(c < dim ? t->q : t->along[c - dim], i);
		to_cells(dim, width, t, at, q, axes);
		keep_last(width, &axes[d]);
		to_cells(dim, width, t, at + (1 << bits_below(dim, d)), q, axes);
	}
}

PM_SIMD_INLINE size_t add(int dim, int width, struct pm_current_cells *t, uint32_t *others)
{
	struct leaving list;
	memset(list.count, 0, sizeof list.count);
	const size_t left = find_leaving(dim, t, others, add_within(dim, width, t, others), &list);
	add_leaving(dim, width, 0, t, &list);
	if (dim > 1)
		add_leaving(dim, width, 1, t, &list);
	if (dim > 2)
		add_leaving(dim, width, 2, t, &list);
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
