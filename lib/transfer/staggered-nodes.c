/* Gather of E and B on Yee's mesh where a tile has many particles. Ex, By and Bz sit half a cell up x; Ey, Ez and Bx do not: the three of a group share their
 * points along x, and along y and z each of them has one of two sets of points, of which that half a cell up begins on the same cell or the next. There is a
 * copy of the tile for each of these four cases, in which the first points of the three components of a group are one node, four numbers side by side, so that
 * a load and a product serve three components. The sums are those of one component after the other (staggered-tile.c), to the last bit.
 * Cost: 2 width^dim products of four numbers a particle, and eight nodes a point of the tile. SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/staggered-nodes.h"
#include "transfer/tile-by-axis.h"

enum { width_most = 4, group = 4 * PM_BLOCK_MOST, copy = 2 * group };

bool pm_staggered_has_nodes(int dim, const struct pm_kernel *k, int components, const unsigned char (*staggered)[3])
{
	const bool spline = k->width >= 2 && k->width <= width_most && k->degree == k->width - 1;
	return dim > 1 && spline && pm_staggered_is_yee(dim, components, staggered);
}

/* A row of three components as nodes. */
static void weave_row(size_t n, const double *restrict a, const double *restrict b, const double *restrict c, double *restrict to)
{
	for (size_t i = 0; i < n; i++)
		*(pm_simd4_at *)(to + 4 * i) = (pm_simd4_at){a[i], b[i], c[i], 0};
}

static bool by_cells(int dim, const struct pm_kernel *k, bool lower) { return lower && dim == 3 && k->width == 2; }

void pm_staggered_weave(int dim, const struct pm_kernel *k, bool lower, const double *blocks, const size_t slots[3], double *nodes)
{
	if (by_cells(dim, k, lower)) {
		pm_staggered_fill_cells(blocks, slots, nodes);
		return;
	}
	const size_t row = (size_t)pm_block_row[dim], plane = row * (size_t)pm_block_rows[dim];
	for (size_t z_up = 0; z_up < (dim > 2 && !lower ? 2 : 1); z_up++)
		for (size_t y_up = 0; y_up < (lower ? 1 : 2); y_up++)
			for (size_t z = 0; z < (dim > 2 ? slots[2] - 1 : 1); z++)
				for (size_t y = 0; y + 1 < slots[1]; y++) {
					const double *at = blocks + z * plane + y * row, *right = at + y_up * row, *above = at + z_up * plane;
					const double *both = right + z_up * plane;
					double *to = nodes + (2 * z_up + y_up) * copy + 4 * (z * plane + y * row);
					weave_row(slots[0], at, above + 4 * PM_BLOCK_MOST, right + 5 * PM_BLOCK_MOST, to);
					weave_row(slots[0], right + PM_BLOCK_MOST, above + 2 * PM_BLOCK_MOST, both + 3 * PM_BLOCK_MOST, to + group);
				}
}

enum { lot = 32, fours = 4 }; /* particles whose weights are found before they are used, which takes four at a time */
typedef pm_by_axis four; /* of four particles, or of the components of a group */
typedef int32_t four_int __attribute__((vector_size(fours * sizeof(int32_t))));

/* Of a lot: weights of both sets of points of each axis, and the first node of each group. */
struct weights {
	double on[3][width_most][lot], up[3][width_most][lot] __attribute__((aligned(32)));
	int32_t at[2][lot] __attribute__((aligned(16)));
};

/* Weights of four particles on an axis, a particle a lane. */
PM_SIMD_INLINE void put_weights(const struct pm_kernel *kernel, int width, four t, double *w)
{
	four of_point[width_most];
	find_by_axis(kernel, width, width - 1, t, of_point);
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++)
		*(four *)(w + k * lot) = of_point[k];
}

/* Those of a lot, from its i-th particle on. */
PM_SIMD_INLINE void find_lot(int dim, int width, bool lower, const struct pm_staggered_tile *t, size_t i, size_t n, struct weights *w)
{
	const int32_t step[3] = {4, 4 * pm_block_row[dim], 4 * pm_block_row[dim] * pm_block_rows[dim]}, up_step[3] = {4, copy, 2 * copy};
	for (size_t l = 0; l < n; l += fours) {
		four_int up_x = {0}, on_x = {group, group, group, group};
		PM_SIMD_UNROLL
		for (int d = 0; d < dim; d++) {
			const four u = *(const pm_simd4_at *)(t->u[d] + i + l), up = u + 0.5;
			pm_simd4_int_at cell, half;
			const four part = (four)pm_simd4_split(u, &cell); /* u >= 0 */
			put_weights(t->kernel, width, part - t->shift, &w->on[d][0][l]);
			if (lower) {
				put_weights(t->lower, width - 1, part - (width % 2 ? 0 : 0.5), &w->up[d][0][l]);
				*(four *)(&w->up[d][width - 1][l]) = (four){0};
				half = cell;
			} else
				put_weights(t->kernel, width, (four)pm_simd4_split(up, &half) - t->shift, &w->up[d][0][l]);
			const four_int place = (cell - (int32_t)t->cell[d]) * step[d], further = (half - cell) * up_step[d];
			up_x += place + further;
			on_x += d == 0 ? place : place + further;
		}
		*(four_int *)(w->at[0] + l) = up_x;
		*(four_int *)(w->at[1] + l) = on_x;
	}
}

/* Lanes of b where bits are set, else of a. */
PM_SIMD_INLINE four blend(four a, four b, int bits)
{
	return (four)(bits == 2 ? pm_simd4_blend(a, b, 2) : bits == 4 ? pm_simd4_blend(a, b, 4) : pm_simd4_blend(a, b, 6));
}

/* The values of a group; of_x: points along x; y, z: the weights of its components. */
PM_SIMD_INLINE four values_of(int dim, int width, int of_x, const double *from, const double (*x)[lot], const four *y, const four *z)
{
	const int row = 4 * pm_block_row[dim], plane = row * pm_block_rows[dim];
	four sum[width_most], total = {0};
	for (int k = 0; k < (dim > 2 ? width : 1); k++)
		PM_SIMD_UNROLL
		for (int j = 0; j < width; j++) {
			const four w = dim > 2 ? y[j] * z[k] : y[j];
			PM_SIMD_UNROLL
			for (int i = 0; i < of_x; i++) {
				const four term = *(const pm_simd4_at *)(from + k * plane + j * row + 4 * i) * w;
				sum[i] = k + j == 0 ? term : sum[i] + term;
			}
		}
	PM_SIMD_UNROLL
	for (int i = 0; i < of_x; i++)
		total += sum[i] * *x[i];
	return total;
}

/* Ex By Bz, Ey Ez Bx of particle l of a lot. */
PM_SIMD_INLINE void gather_one(int dim, int width, bool lower, const double *nodes, const struct weights *w, size_t l, four *up_x, four *on_x)
{
	four y[2][width_most], z[2][width_most];
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++) {
		const four y_on = all_axes(w->on[1][k][l]), y_up = all_axes(w->up[1][k][l]);
		y[0][k] = blend(y_on, y_up, 4), y[1][k] = blend(y_up, y_on, 2);
		if (dim > 2) {
			const four z_on = all_axes(w->on[2][k][l]), z_up = all_axes(w->up[2][k][l]);
			z[0][k] = blend(z_on, z_up, 2), z[1][k] = blend(z_on, z_up, 6);
		}
	}
	*up_x = values_of(dim, width, width - lower, nodes + w->at[0][l], (const double (*)[lot])&w->up[0][0][l], y[0], z[0]);
	*on_x = values_of(dim, width, width, nodes + w->at[1][l], (const double (*)[lot])&w->on[0][0][l], y[1], z[1]);
}

PM_SIMD_INLINE void gather(int dim, int width, bool lower, const struct pm_staggered_tile *t)
{
	static const unsigned char which[2][3] = {{0, 4, 5}, {1, 2, 3}};
	const double *const nodes = t->nodes;
	double *const results = t->results;
	struct weights w;
	for (size_t from = 0; from < t->count; from += lot) {
		const size_t n = t->count - from < lot ? t->count - from : lot;
		find_lot(dim, width, lower, t, from, n, &w);
		for (size_t i = 0; i < n; i += fours) {
			four value[2][fours];
			for (size_t l = 0; l < fours; l++) /* the last one again where there are fewer */
				gather_one(dim, width, lower, nodes, &w, i + l < n ? i + l : n - 1, &value[0][l], &value[1][l]);
			for (int g = 0; g < 2; g++) {
				turn_rows(value[g]);
				for (int c = 0; c < 3; c++)
					*(pm_simd4_at *)(results + which[g][c] * PM_TILE_ORDER_PACK + from + i) = value[g][c];
			}
		}
	}
}

#define LOOPS(dim, width) \
	static void gather_##dim##_##width(const struct pm_staggered_tile *t) { gather(dim, width, false, t); } \
	static void lower_##dim##_##width(const struct pm_staggered_tile *t) { gather(dim, width, true, t); }
LOOPS(2, 2)
LOOPS(2, 3)
LOOPS(2, 4)
LOOPS(3, 2)
LOOPS(3, 3)
LOOPS(3, 4)
#define ROWS(what) {{what##_2_2, what##_2_3, what##_2_4}, {what##_3_2, what##_3_3, what##_3_4}}
static pm_staggered_loop *const loops[2][2][3] = {ROWS(gather), ROWS(lower)};

pm_staggered_loop *pm_staggered_gather_nodes(int dim, const struct pm_kernel *k, bool lower)
{
	return by_cells(dim, k, lower) ? pm_staggered_gather_cells : loops[lower][dim - 2][k->width - 2];
}
