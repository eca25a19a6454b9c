/* The loops over the particles of one tile. Dimension, width and degree of the kernel are constants of inline functions; the weights of all points
 * of an axis are found at once, so that widths 2, 4 and 8 fill a vector (3 and 6 are filled up with zeros). Block points are not wrapped: the
 * faces are seen to when blocks and mesh meet (transfer.c). Cost: width^dim products per particle.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/transfer_tile.h"

#define INLINE static inline __attribute__((always_inline))
enum { batch = 128, lanes = PM_KERNEL_WIDTH };

/* Particles of one batch: place of the first point in the block, distances from the base point. */
struct batch {
	int32_t base[batch];
	double t[3][batch];
};

/* Vector length for a width. */
INLINE int padded(int width) { return width <= 2 ? width : width <= 4 ? 4 : 8; }

/* coefficients[power][lane], lanes beyond the width are 0. */
INLINE void pad_coefficients(const struct pm_kernel *k, int width, int degree, double *to)
{
	for (int power = 0; power <= degree; power++)
		for (int i = 0; i < padded(width); i++)
			to[power * padded(width) + i] = i < width ? k->coefficients[power * width + i] : 0;
}

INLINE void find_weights(int width, int degree, const double *coefficients, double t, double *w)
{
	const int n = padded(width);
	const bool fold = pm_kernel_folds(width, degree, t);
	double s = fold ? 1 - t : t, v[lanes];
	for (int i = 0; i < n; i++)
		v[i] = coefficients[degree * n + i];
	for (int power = degree - 1; power >= 0; power--)
		for (int i = 0; i < n; i++)
			v[i] = v[i] * s + coefficients[power * n + i];
	for (int i = 0; i < n; i++)
		w[i] = fold && i < width ? v[width - 1 - i] : v[i];
}

INLINE void find_places(int dim, const struct pm_tile *t, const double *records, size_t m, struct batch *b)
{
	const int step[3] = {1, pm_block_row[dim], pm_block_row[dim] * pm_block_rows[dim]};
	for (int d = 0; d < dim; d++)
		for (size_t i = 0; i < m; i++) {
			double u = records[i * (size_t)t->stride + (size_t)d];
			int32_t cell = (int32_t)u; /* u >= 0: floor */
			int32_t place = (cell - (int32_t)t->cell[d]) * step[d];
			b->t[d][i] = u - cell - t->shift;
			b->base[i] = d ? b->base[i] + place : place;
		}
}

INLINE void spread(int dim, int width, int degree, const struct pm_tile *t)
{
	const int n = padded(width), row = pm_block_row[dim], plane = row * pm_block_rows[dim];
	double coefficients[(PM_KERNEL_DEGREE + 1) * lanes];
	struct batch b;
	pad_coefficients(t->kernel, width, degree, coefficients);
	for (size_t from = 0; from < t->count; from += batch) {
		size_t m = t->count - from < batch ? t->count - from : batch;
		const double *records = t->records + from * (size_t)t->stride;
		find_places(dim, t, records, m, &b);
		for (size_t i = 0; i < m; i++) {
			double wx[lanes], wy[lanes] = {1}, wz[lanes] = {1}, *block = t->block + b.base[i], q = records[i * (size_t)t->stride + (size_t)t->value];
			find_weights(width, degree, coefficients, b.t[0][i], wx);
			if (dim > 1)
				find_weights(width, degree, coefficients, b.t[1][i], wy);
			if (dim > 2)
				find_weights(width, degree, coefficients, b.t[2][i], wz);
			for (int z = 0; z < (dim > 2 ? width : 1); z++)
				for (int y = 0; y < (dim > 1 ? width : 1); y++) {
					double f = q * wz[z] * wy[y], *points = block + z * plane + y * row;
					for (int x = 0; x < n; x++)
						points[x] += f * wx[x];
				}
		}
	}
}

INLINE void gather(int dim, int width, int degree, const struct pm_tile *t)
{
	const int n = padded(width), row = pm_block_row[dim], plane = row * pm_block_rows[dim];
	double coefficients[(PM_KERNEL_DEGREE + 1) * lanes];
	struct batch b;
	pad_coefficients(t->kernel, width, degree, coefficients);
	for (size_t from = 0; from < t->count; from += batch) {
		size_t m = t->count - from < batch ? t->count - from : batch;
		double *records = t->records + from * (size_t)t->stride;
		find_places(dim, t, records, m, &b);
		for (size_t i = 0; i < m; i++) {
			double wx[lanes], wy[lanes] = {1}, wz[lanes] = {1};
			find_weights(width, degree, coefficients, b.t[0][i], wx);
			if (dim > 1)
				find_weights(width, degree, coefficients, b.t[1][i], wy);
			if (dim > 2)
				find_weights(width, degree, coefficients, b.t[2][i], wz);
			for (int c = 0; c < t->components; c++) {
				const double *block = t->block + (size_t)c * PM_BLOCK_MOST + b.base[i];
				double sum[lanes] = {0}, total = 0;
				for (int z = 0; z < (dim > 2 ? width : 1); z++)
					for (int y = 0; y < (dim > 1 ? width : 1); y++) {
						double f = wz[z] * wy[y];
						const double *points = block + z * plane + y * row;
						for (int x = 0; x < n; x++)
							sum[x] += f * points[x];
					}
				for (int x = 0; x < n; x++)
					total += sum[x] * wx[x];
				records[i * (size_t)t->stride + (size_t)c] = total;
			}
		}
	}
}

/* One function per dimension and width for the degree width-1 (B-splines, M'4 and M'6), and one for any degree. */
#define LOOPS(dim, width, name, degree) \
	static void spread_##name##_##dim##_##width(const struct pm_tile *t) { spread(dim, width, degree, t); } \
	static void gather_##name##_##dim##_##width(const struct pm_tile *t) { gather(dim, width, degree, t); }
#define DIMS(width) \
	LOOPS(1, width, spline, width - 1) LOOPS(2, width, spline, width - 1) LOOPS(3, width, spline, width - 1) \
	LOOPS(1, width, any, t->kernel->degree) LOOPS(2, width, any, t->kernel->degree) LOOPS(3, width, any, t->kernel->degree)
DIMS(1)
DIMS(2)
DIMS(3)
DIMS(4)
DIMS(5)
DIMS(6)
DIMS(7)
DIMS(8)
#define ROW(name, dim) {name##_##dim##_1, name##_##dim##_2, name##_##dim##_3, name##_##dim##_4, name##_##dim##_5, name##_##dim##_6, name##_##dim##_7, \
	name##_##dim##_8}
#define TABLE(name) {ROW(name, 1), ROW(name, 2), ROW(name, 3)}
static pm_tile_loop *const spreads[2][3][PM_KERNEL_WIDTH] = {TABLE(spread_spline), TABLE(spread_any)};
static pm_tile_loop *const gathers[2][3][PM_KERNEL_WIDTH] = {TABLE(gather_spline), TABLE(gather_any)};

pm_tile_loop *pm_tile_spread(int dim, const struct pm_kernel *k) { return spreads[k->degree != k->width - 1][dim - 1][k->width - 1]; }
pm_tile_loop *pm_tile_gather(int dim, const struct pm_kernel *k) { return gathers[k->degree != k->width - 1][dim - 1][k->width - 1]; }
