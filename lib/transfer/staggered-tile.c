/* Gathers of components at several offsets, as those of E and B on Yee's mesh: of an axis there are two sets of weights, that among the nodes and that among
 * the points half a cell up, and every component uses one of them on each. The sums are those of the gather of one component (transfer-tile.c), to the last
 * bit. Cost: width^dim products a component, two sets of weights an axis. SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/staggered-tile.h"
#include "transfer/tile-by-axis.h"

enum { on_nodes, half_up, offsets };

/* On the points of one offset: place of the first one of each axis in the block, weights, and the products of those of y and z, by the offset of z. */
struct support {
	size_t place[offsets][3];
	double w[offsets][3][lanes];
	double across[offsets][offsets][lanes][lanes]; /* [of y][of z][z][y] */
};

/* `lower`: with the kernel one order lower, whose last weight is 0. */
PM_SIMD_INLINE void find_offset(int dim, int width, int degree, bool lower, const struct pm_staggered_tile *t, pm_by_axis u, int offset, struct support *s)
{
	const size_t step[3] = {1, (size_t)pm_block_row[dim], (size_t)(pm_block_row[dim] * pm_block_rows[dim])};
	const pm_simd4_int_at cell = __builtin_convertvector(u, pm_simd4_int_at); /* u >= 0 */
	pm_by_axis w[lanes];
	if (lower)
		find_by_axis(t->lower, width - 1, width - 2, u - __builtin_convertvector(cell, pm_by_axis) - (width % 2 ? 0 : 0.5), w);
	else
		find_by_axis(t->kernel, width, degree, u - __builtin_convertvector(cell, pm_by_axis) - t->shift, w);
	PM_SIMD_UNROLL
	for (int k = width - 1; k < (width + 3) / 4 * 4; k++)
		w[k] = k < width && !lower ? w[k] : all_axes(0);
	rows_of_axes(dim, padded(width), w, s->w[offset]);
	for (int d = 0; d < dim; d++)
		s->place[offset][d] = (size_t)(cell[d] - (int32_t)t->cell[d]) * step[d];
}

PM_SIMD_INLINE double component(int dim, int width, const struct support *s, const unsigned char staggered[3], const double *block)
{
	const int n = padded(width), row = pm_block_row[dim], plane = row * pm_block_rows[dim];
	const int x = staggered[0], y = dim > 1 ? staggered[1] : 0, z = dim > 2 ? staggered[2] : 0;
	const double *from = block + s->place[x][0] + (dim > 1 ? s->place[y][1] : 0) + (dim > 2 ? s->place[z][2] : 0), *w = s->w[x][0];
	double sum[lanes], total = 0;
	for (int k = 0; k < (dim > 2 ? width : 1); k++)
		for (int j = 0; j < (dim > 1 ? width : 1); j++)
			if (k + j == 0)
				row_set(n, s->across[y][z][k][j], from, sum);
			else
				row_add(n, s->across[y][z][k][j], from + k * plane + j * row, sum);
	PM_SIMD_UNROLL
	for (int i = 0; i < n; i++)
		total += sum[i] * w[i];
	return total;
}

/* E and B on Yee's mesh: E half a cell up its own axis, B up both others. */
enum { yee_components = 6 };
PM_SIMD_INLINE bool yee_half(int dim, int c, int d) { return d < dim && (c % 3 == d) == (c < 3); }

bool pm_staggered_is_yee(int dim, int components, const unsigned char (*staggered)[3])
{
	bool is = components == yee_components;
	for (int c = 0; c < components && is; c++)
		for (int d = 0; d < dim; d++)
			is = is && staggered[c][d] == yee_half(dim, c, d);
	return is;
}

PM_SIMD_INLINE void gather(int dim, int width, int degree, bool yee, bool lower, const struct pm_staggered_tile *t)
{
	const int n = padded(width);
	struct support s;
	for (int o = 0; o < offsets; o++)
		for (int d = dim; d < 3; d++)
			s.w[o][d][0] = 1;
	for (size_t i = 0; i < t->count; i++) {
		const pm_by_axis u = axes_from(dim, t->records + i * (size_t)t->stride);
		double *result = t->results + i * (size_t)t->components;
		find_offset(dim, width, degree, false, t, u, on_nodes, &s);
		find_offset(dim, width, degree, lower, t, lower ? u : u + 0.5, half_up, &s);
		for (int y = 0; y < (dim > 1 ? offsets : 1); y++)
			for (int z = 0; z < (dim > 2 ? offsets : 1); z++)
				for (int k = 0; k < (dim > 2 ? width : 1); k++)
					row_set(dim > 1 ? n : 1, s.w[z][2][k], s.w[y][1], s.across[y][z][k]);
		if (yee) {
			PM_SIMD_UNROLL
			for (int c = 0; c < yee_components; c++)
				result[c] = component(dim, width, &s, (const unsigned char[3]){yee_half(dim, c, 0), yee_half(dim, c, 1), yee_half(dim, c, 2)},
					t->block + (size_t)c * PM_BLOCK_MOST);
		} else
			for (int c = 0; c < t->components; c++)
				result[c] = component(dim, width, &s, t->staggered[c], t->block + (size_t)c * PM_BLOCK_MOST);
	}
}

/* Offsets and degree are constants for the splines of two to four points, which is what plasmas use; a function per dimension and width for the rest. */
#define LOOPS(dim, width) static void any_##dim##_##width(const struct pm_staggered_tile *t) { gather(dim, width, t->kernel->degree, false, false, t); }
#define YEE(dim, width) \
	static void yee_##dim##_##width(const struct pm_staggered_tile *t) { gather(dim, width, width - 1, true, false, t); } \
	static void lower_##dim##_##width(const struct pm_staggered_tile *t) { gather(dim, width, width - 1, false, true, t); }
#define DIMS(loops, width) loops(1, width) loops(2, width) loops(3, width)
DIMS(LOOPS, 1)
DIMS(LOOPS, 2)
DIMS(LOOPS, 3)
DIMS(LOOPS, 4)
DIMS(LOOPS, 5)
DIMS(LOOPS, 6)
DIMS(LOOPS, 7)
DIMS(LOOPS, 8)
DIMS(LOOPS, 9)
DIMS(LOOPS, 10)
DIMS(YEE, 2)
DIMS(YEE, 3)
DIMS(YEE, 4)
#define ROW(dim) {any_##dim##_1, any_##dim##_2, any_##dim##_3, any_##dim##_4, any_##dim##_5, any_##dim##_6, any_##dim##_7, any_##dim##_8, any_##dim##_9, \
	any_##dim##_10}
static pm_staggered_loop *const any[3][PM_KERNEL_WIDTH] = {ROW(1), ROW(2), ROW(3)};
#define SPLINES(what) {{what##_1_2, what##_1_3, what##_1_4}, {what##_2_2, what##_2_3, what##_2_4}, {what##_3_2, what##_3_3, what##_3_4}}
static pm_staggered_loop *const yee[3][3] = SPLINES(yee), *const lower[3][3] = SPLINES(lower);

pm_staggered_loop *pm_staggered_gather(int dim, const struct pm_kernel *k, bool to_lower, int components, const unsigned char (*staggered)[3])
{
	if (to_lower)
		return lower[dim - 1][k->width - 2];
	const bool spline = k->width >= 2 && k->width <= 4 && k->degree == k->width - 1 && pm_staggered_is_yee(dim, components, staggered);
	return spline ? yee[dim - 1][k->width - 2] : any[dim - 1][k->width - 1];
}
