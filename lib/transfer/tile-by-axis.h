/* The weights of a kernel on all axes of a particle together, an axis a lane. For lib/transfer and lib/current.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_BY_AXIS_H
#define PM_TRANSFER_TILE_BY_AXIS_H

#include "transfer/tile-lanes.h"

typedef double pm_by_axis __attribute__((vector_size(4 * sizeof(double)))); /* three axes, and a lane to spare */
typedef int64_t pm_mask_by_axis __attribute__((vector_size(4 * sizeof(double))));

PM_SIMD_INLINE pm_by_axis all_axes(double x) { return (pm_by_axis){x, x, x, x}; }
PM_SIMD_INLINE pm_by_axis where(pm_mask_by_axis m, pm_by_axis yes, pm_by_axis no)
{
	return (pm_by_axis)((m & (pm_mask_by_axis)yes) | (~m & (pm_mask_by_axis)no));
}
PM_SIMD_INLINE pm_by_axis axes_from(int dim, const double *x) { return (pm_by_axis){x[0], dim > 1 ? x[1] : 0, dim > 2 ? x[2] : 0}; }

/* w[k] of point k on every axis: those of find_weights (tile-lanes.h) to the last bit. */
PM_SIMD_INLINE void find_by_axis(const struct pm_kernel *kernel, int width, int degree, pm_by_axis t, pm_by_axis *w)
{
	if (width == 2 && degree == 1) { /* cic alone has two points: what Horner would give */
		w[0] = 1 - t, w[1] = t;
		return;
	}
	const bool may_fold = pm_kernel_folds(width, degree, 1);
	const pm_mask_by_axis fold = t > 0.5;
	const pm_by_axis s = may_fold ? where(fold, 1 - t, t) : t;
	pm_by_axis v[lanes];
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++) {
		v[k] = all_axes(kernel->coefficients[degree * width + k]);
		for (int power = degree - 1; power >= 0; power--)
			v[k] = v[k] * s + kernel->coefficients[power * width + k];
	}
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++)
		w[k] = may_fold ? where(fold, v[width - 1 - k], v[k]) : v[k];
}

/* Four rows of four numbers become columns. */
PM_SIMD_INLINE void turn_rows(pm_by_axis r[4])
{
	const pm_by_axis a = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6), b = __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7);
	const pm_by_axis c = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6), d = __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);
	r[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5), r[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
	r[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7), r[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

/* v[k] of every axis, filled up to a multiple of four, to rows of n lanes of each. */
PM_SIMD_INLINE void rows_of_axes(int dim, int n, const pm_by_axis *v, double to[3][lanes])
{
	for (int k = 0; k < n; k += 4) {
		const pm_by_axis *r = v + k;
		const pm_by_axis a = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6), b = __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7);
		const pm_by_axis c = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6), d = __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);
		*(pm_simd4_at *)(to[0] + k) = __builtin_shufflevector(a, c, 0, 1, 4, 5);
		if (dim > 1)
			*(pm_simd4_at *)(to[1] + k) = __builtin_shufflevector(b, d, 0, 1, 4, 5);
		if (dim > 2)
			*(pm_simd4_at *)(to[2] + k) = __builtin_shufflevector(a, c, 2, 3, 6, 7);
	}
}

#endif
