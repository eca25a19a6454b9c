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

#endif
