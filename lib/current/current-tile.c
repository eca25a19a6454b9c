/* Esirkepov's current: with S0 and S1 the weights along an axis at both ends of the way, D = S1 - S0 and A = (S0 + S1)/2, the charge that passes from point i
 * to i + 1 along x is -q sum_{i' <= i} D_x(i') [A_y A_z + D_y D_z/12], and likewise along y and z: eq. 31 of the paper, in symmetric form. An axis above dim
 * has A = 1, D = 0, and the current along it is q v [A_x A_y + D_x D_y/12]. It holds for any kernel, because D sums to 0. A way whose ends have the same points
 * on every axis has a window of width points (of up to four), any other one of width + 1. The weights of all axes are found together, an axis a lane.
 * Source: Esirkepov 2001, Computer Physics Communications 135, 144. Cost: 3 width^dim products a particle, or 3 (width + 1)^dim.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "current/current-tile.h"
#include "transfer/tile-by-axis.h"

enum { room = lanes };

/* What each axis has: mean, difference, and charge passed from each point to the next; lanes beyond the window are 0. */
struct along {
	double mean[3][room], change[3][room], passed[3][room];
};

/* Lanes of a window. */
PM_SIMD_INLINE int window(int points) { return points == 1 ? 1 : padded(points); }

/* Weight k of `width`, or, where they are one point further on, of the one before. */
PM_SIMD_INLINE pm_by_axis weight_at(int points, int width, int k, const pm_by_axis *w, pm_mask_by_axis on)
{
	const pm_by_axis here = k < width ? w[k] : all_axes(0);
	return points == width ? here : where(on, k > 0 && k <= width ? w[k - 1] : all_axes(0), here);
}

/* The window of `points` points that has both ends of the way: it ends in the cell below the one where it begins, there, or above. */
PM_SIMD_INLINE void find_along(int dim, int points, int width, const pm_by_axis *from, const pm_by_axis *to, pm_mask_by_axis below, pm_mask_by_axis above,
	struct along *a)
{
	pm_by_axis mean[room], change[room], passed[room], sum = {0};
	PM_SIMD_UNROLL
	for (int k = 0; k < (points + 3) / 4 * 4; k++) {
		const pm_by_axis here = weight_at(points, width, k, from, below), there = weight_at(points, width, k, to, above);
		mean[k] = 0.5 * (here + there);
		change[k] = there - here;
		sum -= change[k];
		passed[k] = k < points - 1 ? sum : all_axes(0);
	}
	rows_of_axes(dim, window(points), mean, a->mean);
	rows_of_axes(dim, window(points), change, a->change);
	rows_of_axes(dim, window(points), passed, a->passed);
}

/* A way within `points` points on every axis to the blocks; charge of each component. */
PM_SIMD_INLINE void deposit_window(int dim, int points, const struct along *a, const double charge[3], size_t at, double *const block[3])
{
	const int n = window(points), row = pm_block_row[dim], plane = row * pm_block_rows[dim];
	const int rows = dim > 1 ? points : 1, planes = dim > 2 ? points : 1, passed_rows = dim > 1 ? points - 1 : 1, passed_planes = dim > 2 ? points - 1 : 1;
	double across[room], of_row[room][room], of_plane[room]; /* of x: a number a row; of z: a row for each y; of y: a row for each z */
	for (int y = 0; y < rows; y++) {
		row_set(n, a->mean[1][y], a->mean[0], of_row[y]);
		row_add(n, a->change[1][y] * (1. / 12), a->change[0], of_row[y]);
	}
	PM_SIMD_UNROLL
	for (int z = 0; z < planes; z++) {
		const double mean = a->mean[2][z], change = a->change[2][z] * (1. / 12), through = charge[2] * a->passed[2][z];
		const size_t from = at + (size_t)(z * plane);
		row_set(dim > 1 ? n : 1, charge[0] * mean, a->mean[1], across);
		row_add(dim > 1 ? n : 1, charge[0] * change, a->change[1], across);
		row_set(n, charge[1] * mean, a->mean[0], of_plane);
		row_add(n, charge[1] * change, a->change[0], of_plane);
		PM_SIMD_UNROLL
		for (int y = 0; y < rows; y++) {
			row_add(n, across[y], a->passed[0], block[0] + from + y * row);
			if (y < passed_rows)
				row_add(n, a->passed[1][y], of_plane, block[1] + from + y * row);
			if (z < passed_planes)
				row_add(n, through, of_row[y], block[2] + from + y * row);
		}
	}
}

PM_SIMD_INLINE void deposit(int dim, int width, int degree, const struct pm_current_tile *t)
{
	const int row = pm_block_row[dim], plane = row * pm_block_rows[dim];
	struct along a = {{{0}}, {{0}}, {{0}}};
	for (int d = dim; d < 3; d++)
		a.mean[d][0] = a.passed[d][0] = 1;
	for (size_t p = 0; p < t->count; p++) {
		const double *record = t->records + p * (size_t)t->stride, q = record[2 * dim];
		const pm_by_axis u = axes_from(dim, record), way = axes_from(dim, record + dim);
		const pm_simd4_int_at cell = __builtin_convertvector(u, pm_simd4_int_at);
		const pm_by_axis begins = u - __builtin_convertvector(cell, pm_by_axis), ends = begins + way; /* from the cell on */
		const pm_mask_by_axis below = ends < 0, above = ends >= 1;
		const pm_simd4_int_at first = cell + 1 + __builtin_convertvector(below, pm_simd4_int_at);
		pm_by_axis from[room], to[room];
		find_by_axis(t->kernel, width, degree, begins - t->shift, from);
		find_by_axis(t->kernel, width, degree, ends - t->shift + (where(below, all_axes(1), all_axes(0)) - where(above, all_axes(1), all_axes(0))), to);
		const double charge[3] = {q, dim > 1 ? q : record[dim + 2], dim > 2 ? q : record[dim + 3]};
		size_t at = (size_t)(first[0] - (int32_t)t->cell[0]);
		if (dim > 1)
			at += (size_t)(first[1] - (int32_t)t->cell[1]) * (size_t)row;
		if (dim > 2)
			at += (size_t)(first[2] - (int32_t)t->cell[2]) * (size_t)plane;
		const pm_mask_by_axis beside = below | above;
		if (width > 4 || beside[0] | beside[1] | beside[2]) { /* of many points one more costs little */
			find_along(dim, width + 1, width, from, to, below, above, &a);
			deposit_window(dim, width + 1, &a, charge, at, t->block);
		} else {
			find_along(dim, width, width, from, to, below, above, &a);
			deposit_window(dim, width, &a, charge, at, t->block);
		}
	}
}

#define LOOPS(dim, width) \
	static void spline_##dim##_##width(const struct pm_current_tile *t) { deposit(dim, width, width - 1, t); } \
	static void any_##dim##_##width(const struct pm_current_tile *t) { deposit(dim, width, t->kernel->degree, t); }
#define DIMS(width) LOOPS(1, width) LOOPS(2, width) LOOPS(3, width)
DIMS(1)
DIMS(2)
DIMS(3)
DIMS(4)
DIMS(5)
DIMS(6)
DIMS(7)
DIMS(8)
DIMS(9)
DIMS(10)
#define ROW(name, dim) {name##_##dim##_1, name##_##dim##_2, name##_##dim##_3, name##_##dim##_4, name##_##dim##_5, name##_##dim##_6, name##_##dim##_7, \
	name##_##dim##_8, name##_##dim##_9, name##_##dim##_10}
static pm_current_loop *const loops[2][3][PM_KERNEL_WIDTH] = {{ROW(spline, 1), ROW(spline, 2), ROW(spline, 3)}, {ROW(any, 1), ROW(any, 2), ROW(any, 3)}};

pm_current_loop *pm_current_deposit(int dim, const struct pm_kernel *k) { return loops[k->degree != k->width - 1][dim - 1][k->width - 1]; }
