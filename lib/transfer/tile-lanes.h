/* Rows of a few lanes, and the weights of a kernel in them: all points of an axis at once. Private to lib/transfer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_LANES_H
#define PM_TRANSFER_TILE_LANES_H

#include "transfer/transfer-tile.h"

enum { lanes = 12 }; /* of the largest width */

/* Vector length for a width. */
PM_SIMD_INLINE int padded(int width) { return width <= 2 ? width : width <= 4 ? 4 : width <= 8 ? 8 : lanes; }

/* A row of n lanes in parts of one register, which stay there where all indices are constants. */
struct row {
	pm_simd8_at eight;
	pm_simd4_at four[lanes / 4];
	pm_simd2_at two[lanes / 2];
	double one;
};
#define ROW_TWOS(OP, from) OP(two[(from) / 2], from) OP(two[(from) / 2 + 1], (from) + 2)
#define ROW_FOUR(OP, from) if ((int)PM_SIMD_PART >= 4) { OP(four[(from) / 4], from) } else { ROW_TWOS(OP, from) }
#define ROW_EIGHT(OP) if ((int)PM_SIMD_PART == 8) { OP(eight, 0) } else { ROW_FOUR(OP, 0) ROW_FOUR(OP, 4) }
#define ROW_PARTS(n, OP) \
	switch (n) { \
	case 2: OP(two[0], 0) break; \
	case 4: ROW_FOUR(OP, 0) break; \
	case 6: ROW_FOUR(OP, 0) OP(two[2], 4) break; \
	case 8: ROW_EIGHT(OP) break; \
	case lanes: ROW_EIGHT(OP) ROW_FOUR(OP, 8) break; \
	default: OP(one, 0) \
	}
#define ROW_AT(p, part, from) (*(__typeof__(((struct row *)0)->part) *)((p) + (from)))
#define ROW_CONST(p, part, from) (*(const __typeof__(((struct row *)0)->part) *)((p) + (from)))

PM_SIMD_INLINE struct row row_zero(void) { return (struct row){{0}, {{0}}, {{0}}, 0}; }

/* y = a * x, y += a * x; r = a * x, r += a * x, r = r * a + x, y = r. */
PM_SIMD_INLINE void row_set(int n, double a, const double *x, double *y)
{
#define SET(part, from) ROW_AT(y, part, from) = ROW_CONST(x, part, from) * a;
	ROW_PARTS(n, SET)
#undef SET
}
PM_SIMD_INLINE void row_add(int n, double a, const double *x, double *y)
{
#define ADD(part, from) ROW_AT(y, part, from) += ROW_CONST(x, part, from) * a;
	ROW_PARTS(n, ADD)
#undef ADD
}
PM_SIMD_INLINE void row_take(int n, double a, const double *x, struct row *r)
{
#define TAKE(part, from) r->part = ROW_CONST(x, part, from) * a;
	ROW_PARTS(n, TAKE)
#undef TAKE
}
PM_SIMD_INLINE void row_more(int n, double a, const double *x, struct row *r)
{
#define MORE(part, from) r->part += ROW_CONST(x, part, from) * a;
	ROW_PARTS(n, MORE)
#undef MORE
}
PM_SIMD_INLINE void row_horner(int n, double a, const double *x, struct row *r)
{
#define HORNER(part, from) r->part = r->part * a + ROW_CONST(x, part, from);
	ROW_PARTS(n, HORNER)
#undef HORNER
}
PM_SIMD_INLINE void row_put(int n, const struct row *r, double *y)
{
#define PUT(part, from) ROW_AT(y, part, from) = r->part;
	ROW_PARTS(n, PUT)
#undef PUT
}
/* The lanes of r, times those of w, from the first on. */
PM_SIMD_INLINE double row_sum(int n, int width, const struct row *r, const double *w)
{
	double product[lanes], sum = 0;
#define TIMES(part, from) ROW_AT(product, part, from) = r->part * ROW_CONST(w, part, from);
	ROW_PARTS(n, TIMES)
#undef TIMES
	PM_SIMD_UNROLL
	for (int x = 0; x < width; x++)
		sum += product[x];
	return sum;
}

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
	const double s = fold ? 1 - t : t;
	struct row v;
	row_take(n, 1, coefficients + degree * n, &v);
	for (int power = degree - 1; power >= 0; power--)
		row_horner(n, s, coefficients + power * n, &v);
	row_put(n, &v, w);
	if (fold)
		for (int i = 0; 2 * i < width - 1; i++) {
			const double other = w[i];
			w[i] = w[width - 1 - i];
			w[width - 1 - i] = other;
		}
}

/* Place of a particle's first point in the block, and its weights; axes above dim have the weight 1. */
PM_SIMD_INLINE size_t find_support(int dim, int width, int degree, const struct pm_tile *t, const double *coefficients, const double *record,
	double w[3][lanes])
{
	const int row = pm_block_row[dim], plane = row * pm_block_rows[dim];
	double distance[4];
	int32_t cell[4];
	pm_simd4_at u = *(const pm_simd4_at *)record; /* lanes from dim on hold other values */
	*(pm_simd4_at *)distance = pm_simd4_split(u, (pm_simd4_int_at *)cell) - t->shift; /* u >= 0 */
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
