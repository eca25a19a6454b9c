/* The law of sums (docs/distributed.md): what is added up over a set or a mesh is defined by the stream, not by who computes it. A part is what a block of
 * particles or a row of a mesh gives, made by whoever has its data; parts are joined in the order of the stream: of a set block after block, of a mesh rows
 * to planes, then planes to the mesh. A part is plain bytes, so it can be made in one place and joined in another. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_BASE_IN_ORDER_H
#define PM_BASE_IN_ORDER_H

#include "base/base.h"

enum { PM_PART_MOST = 512 }; /* bytes of a part */

struct pm_parts {
	size_t size;      /* bytes of a part, a multiple of 8, at most PM_PART_MOST */
	const void *none; /* the part of nothing, which a part is before it is made or joined to; NULL: zeros */
	/* Adds values from <= i < to to a part: of a block, or of a row of a mesh. */
	void (*make)(const void *data, size_t from, size_t to, void *part);
	void (*join)(size_t size, const void *part, void *all);
};

/* For parts that are struct pm_sum and nothing else: sum, then carry, of each. */
void pm_join_sums(size_t size, const void *part, void *all);

/* Parts first..first + count - 1 of n values in blocks of `block`, or of the planes of a mesh (in 2-D and 1-D of its rows); any number of threads. */
void pm_parts_of_blocks(const struct pm_parts *p, const void *data, size_t n, size_t block, size_t first, size_t count, void *parts);
void pm_parts_of_mesh(const struct pm_parts *p, const void *data, const size_t points[3], size_t first, size_t count, void *parts);
/* Joins consecutive parts to those before them. */
void pm_join_parts(const struct pm_parts *p, size_t count, const void *parts, void *all);

/* The same from the first to the last, joined to all: over n values in blocks of pm_sum_block, and over a mesh. */
void pm_over_set(const struct pm_parts *p, const void *data, size_t n, void *all);
void pm_over_mesh(const struct pm_parts *p, const void *data, const size_t points[3], void *all);

/* Sums of values, or of products where y is not NULL. The rows of a mesh are added with the weights of quadrature of each axis at its ends, 1 or 1/2 (NULL:
 * 1 everywhere). */
void pm_sum_of_set(size_t n, const double *x, const double *y, struct pm_sum *all);
void pm_sum_of_mesh(const size_t points[3], const double *x, const double *y, const double end[3][2], struct pm_sum *all);
/* The latter as parts, whose data are these: values from row number `row` of the mesh on. */
struct pm_mesh_values {
	const double *x, *y;
	const size_t *points;
	const double (*end)[2];
	size_t row;
};
extern const struct pm_parts pm_mesh_sums;
/* Of one number per row. */
double pm_sum_of_rows(const size_t points[3], const double *row);
/* The same as parts over a mesh, whose data are these: numbers from the first row here on, of rows of so many points. */
struct pm_row_values {
	const double *row;
	size_t points;
};
extern const struct pm_parts pm_row_sums;

#endif
