/* An axis of a mesh goes on beyond its ends: it repeats if periodic; else it is mirrored, even (a scalar at a neumann face) or odd (at a wall), about the
 * end node, or about the face itself for values half a cell off the nodes. Which point is point i of that, and with what sign. Cost: a comparison for
 * points of the mesh itself. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_INDEX_FOLD_H
#define PM_MESH_INDEX_FOLD_H

#include <stdbool.h>
#include <stddef.h>

struct pm_index_axis {
	size_t points; /* 0 <= i < points are the mesh's own */
	bool periodic;
	bool staggered; /* half a cell off the nodes */
	int image[2];  /* factor of the image at the low and the high end: 1 even, -1 odd, 0 none */
};

/* The same for any i: index-fold.c. */
size_t pm_index_beyond(ptrdiff_t i, const struct pm_index_axis *a, int *factor);

/* The point of the mesh at which the value of point i stands, and its factor; on an axis of one node nothing varies. */
static inline size_t pm_index_image(ptrdiff_t i, const struct pm_index_axis *a, int *factor)
{
	*factor = 1;
	return (size_t)i < a->points ? (size_t)i : pm_index_beyond(i, a, factor);
}

/* The same for nodes with even images. */
static inline size_t pm_index_fold(ptrdiff_t i, size_t points, bool periodic)
{
	int factor;
	return (size_t)i < points ? (size_t)i : pm_index_beyond(i, &(struct pm_index_axis){.points = points, .periodic = periodic, .image = {1, 1}}, &factor);
}

/* The neighbours of node i of the mesh, likewise: a formula without a call, for loops over short rows. */
static inline size_t pm_index_below(size_t i, size_t points, bool periodic) { return i ? i - 1 : periodic ? points - 1 : points > 1; }
static inline size_t pm_index_above(size_t i, size_t points, bool periodic) { return i + 1 < points ? i + 1 : periodic ? 0 : i - (points > 1); }

#endif
