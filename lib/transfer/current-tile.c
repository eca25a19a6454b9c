/* Esirkepov's current: with S0 and S1 the weights along an axis at both ends of the way, D = S1 - S0 and A = (S0 + S1)/2, the charge that passes from point i
 * to i + 1 along x is -q sum_{i' <= i} D_x(i') [A_y A_z + D_y D_z/12], and likewise along y and z: eq. 31 of the paper, in symmetric form. An axis above dim
 * has A = 1, D = 0, and the current along it is q v [A_x A_y + D_x D_y/12]. It holds for any kernel, because D sums to 0.
 * Source: Esirkepov 2001, Computer Physics Communications 135, 144. Cost: 3 (width + 1)^dim products a particle.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/current-tile.h"
#include "transfer/tile-lanes.h"

enum { room = 2 * PM_KERNEL_WIDTH };

/* What one axis has: mean, difference, and charge passed from each point to the next; lanes beyond width are 0. */
struct along {
	double mean[room], change[room], passed[room];
};

PM_SIMD_INLINE int window(int width) { return width < 8 ? padded(width + 1) : width + 1; }

/* Weights of a window of width + 1 points at u, which is in its first cell or the next. */
PM_SIMD_INLINE void place_weights(int width, int degree, const double *coefficients, double u, double shift, int32_t cell, double *w)
{
	const int32_t own = (int32_t)u > cell ? cell + 1 : cell; /* a way of one cell may round up to the next but one */
	double v[lanes];
	find_weights(width, degree, coefficients, u - own - shift, v);
	for (int i = 0; i < window(width); i++)
		w[i] = 0;
	for (int i = 0; i < width; i++)
		w[i + (own > cell)] = v[i];
}

PM_SIMD_INLINE void find_along(int width, int degree, const double *coefficients, double u, double way, double shift, int32_t cell, struct along *a)
{
	double low[room], high[room], sum = 0;
	const double sign = way < 0 ? -1 : 1;
	place_weights(width, degree, coefficients, u, shift, cell, low);
	place_weights(width, degree, coefficients, u + fabs(way), shift, cell, high);
	for (int i = 0; i < window(width); i++) {
		a->mean[i] = 0.5 * (low[i] + high[i]);
		a->change[i] = sign * (high[i] - low[i]);
	}
	for (int i = 0; i < window(width); i++) {
		sum -= a->change[i];
		a->passed[i] = i < width ? sum : 0;
	}
}

/* row += f x + g y. */
PM_SIMD_INLINE void add_two(int n, double f, const double *restrict x, double g, const double *restrict y, double *restrict row)
{
	for (int i = 0; i < n; i++)
		row[i] += f * x[i] + g * y[i];
}

PM_SIMD_INLINE void deposit(int dim, int width, int degree, const struct pm_current_tile *t)
{
	const int n = window(width), row = pm_block_row[dim], plane = row * pm_block_rows[dim];
	const int points[3] = {width + 1, dim > 1 ? width + 1 : 1, dim > 2 ? width + 1 : 1};
	double coefficients[(PM_KERNEL_DEGREE + 1) * lanes];
	struct along a[3] = {{{0}, {0}, {0}}};
	pad_coefficients(t->kernel, width, degree, coefficients);
	for (int d = dim; d < 3; d++)
		a[d].mean[0] = a[d].passed[0] = 1;
	for (size_t p = 0; p < t->count; p++) {
		const double *record = t->records + p * (size_t)t->stride, q = record[2 * dim];
		double charge[3] = {q, q, q};
		size_t at = 0;
		for (int d = dim - 1; d >= 0; d--) {
			const int32_t cell = (int32_t)record[d];
			find_along(width, degree, coefficients, record[d], record[dim + d], t->shift, cell, &a[d]);
			at += ((size_t)cell - t->cell[d]) * (size_t)(d == 0 ? 1 : d == 1 ? row : plane);
		}
		for (int d = dim; d < 3; d++)
			charge[d] = record[dim + 1 + d];
		for (int z = 0; z < points[2]; z++)
			for (int y = 0; y < points[1]; y++) {
				const double my = a[1].mean[y], dy = a[1].change[y] * (1. / 12), mz = a[2].mean[z], dz = a[2].change[z];
				const size_t line = at + (size_t)(z * plane + y * row);
				const double across = charge[0] * (my * mz + dy * dz);
				double *restrict to = t->block[0] + line;
				for (int x = 0; x < n; x++)
					to[x] += across * a[0].passed[x];
				const double fy = charge[1] * a[1].passed[y], fz = charge[2] * a[2].passed[z];
				add_two(n, fy * mz, a[0].mean, fy * dz * (1. / 12), a[0].change, t->block[1] + line);
				add_two(n, fz * my, a[0].mean, fz * dy, a[0].change, t->block[2] + line);
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
