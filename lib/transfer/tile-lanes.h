/* Rows of a few lanes, and the weights of a kernel in them: all points of an axis at once. Private to lib/transfer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_LANES_H
#define PM_TRANSFER_TILE_LANES_H

#include "base/simd.h"
#include "transfer/transfer-tile.h"

enum { lanes = 12 }; /* of the largest width */

/* Vector length for a width. */
PM_SIMD_INLINE int padded(int width) { return width <= 2 ? width : width <= 4 ? 4 : width <= 8 ? 8 : lanes; }

/* y = a * x, y += a * x, y = y * a + x, for n lanes. */
#define PART(type, from, y, x, statement) { typedef type vec; vec *v = (vec *)((y) + (from)); const vec *u = (const vec *)((x) + (from)); statement; }
#define LANES(n, y, x, statement) \
	switch (n) { \
	case 2: PART(pm_simd2_at, 0, y, x, statement) break; \
	case 4: PART(pm_simd4_at, 0, y, x, statement) break; \
	case 8: PART(pm_simd8_at, 0, y, x, statement) break; \
	case lanes: PART(pm_simd8_at, 0, y, x, statement) PART(pm_simd4_at, 8, y, x, statement) break; \
	default: { double *v = (y); const double *u = (x); statement; } \
	}
PM_SIMD_INLINE void row_set(int n, double a, const double *x, double *y) { LANES(n, y, x, *v = *u * a) }
PM_SIMD_INLINE void row_add(int n, double a, const double *x, double *y) { LANES(n, y, x, *v += *u * a) }
PM_SIMD_INLINE void row_horner(int n, double a, const double *x, double *y) { LANES(n, y, x, *v = *v * a + *u) }

/* coefficients[power][lane], lanes beyond the width are 0. */
PM_SIMD_INLINE void pad_coefficients(const struct pm_kernel *k, int width, int degree, double *to)
{
	for (int power = 0; power <= degree; power++)
		for (int i = 0; i < padded(width); i++)
			to[power * padded(width) + i] = i < width ? k->coefficients[power * width + i] : 0;
}

PM_SIMD_INLINE void find_weights(int width, int degree, const double *coefficients, double t, double *w)
{
	const int n = padded(width);
	const bool fold = pm_kernel_folds(width, degree, t);
	double v[lanes];
	row_set(n, 1, coefficients + degree * n, v);
	for (int power = degree - 1; power >= 0; power--)
		row_horner(n, fold ? 1 - t : t, coefficients + power * n, v);
	row_set(n, 1, v, w);
	if (fold)
		for (int i = 0; i < width; i++)
			w[i] = v[width - 1 - i];
}

/* Place of a particle's first point in the block, and its weights; axes above dim have the weight 1. */
PM_SIMD_INLINE size_t find_support(int dim, int width, int degree, const struct pm_tile *t, const double *coefficients, const double *record,
	double w[3][lanes])
{
	const int row = pm_block_row[dim], plane = row * pm_block_rows[dim];
	double distance[4];
	int32_t cell[4];
	pm_simd4_at u = *(const pm_simd4_at *)record + *(const pm_simd4_at *)t->lift; /* lanes from dim on hold other values */
	pm_simd4_int_at floor_u = __builtin_convertvector(u, pm_simd4_int_at); /* u >= 0 */
	*(pm_simd4_int_at *)cell = floor_u;
	*(pm_simd4_at *)distance = u - __builtin_convertvector(floor_u, pm_simd4_at) - t->shift;
	for (int d = 0; d < 3; d++)
		if (d < dim)
			find_weights(width, degree, coefficients, distance[d], w[d]);
		else
			w[d][0] = 1;
	size_t place = (size_t)cell[0] - t->cell[0];
	if (dim > 1)
		place += ((size_t)cell[1] - t->cell[1]) * (size_t)row;
	if (dim > 2)
		place += ((size_t)cell[2] - t->cell[2]) * (size_t)plane;
	return place;
}

#endif
