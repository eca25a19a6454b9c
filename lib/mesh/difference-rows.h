/* One row of a difference along an axis. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_DIFFERENCE_ROWS_H
#define PM_MESH_DIFFERENCE_ROWS_H

#include "mesh/gradient.h"

struct pm_taps {
	int n;
	ptrdiff_t at[PM_TAPS]; /* node; of the regular ones the distance from the node */
	double w[PM_TAPS];     /* regular: pairs up and down of weight +-w (first derivative) or w (second, with the middle behind them) */
};

/* The nodes low <= i < points-high have the regular taps, the others their own. */
struct pm_difference_axis {
	size_t points, low, high;
	ptrdiff_t stride;
	bool around; /* periodic, and divided among ranks */
	bool pairs;  /* periodic: the taps of the others are those of all, elsewhere */
	struct pm_taps regular, end[PM_ENDS];
};

/* A row of a mesh: in: the component, of which the first row here is number 0; row: where that at (0, j, k) starts; at: j or k. */
struct pm_difference_row {
	const struct pm_difference_axis *axis;
	int d;
	const double *in;
	size_t row, at;
};

/* Do the taps of all nodes come in pairs, but for nodes at the ends of a row along it? */
static inline bool pm_difference_regular(const struct pm_difference_row *r)
{
	return r->d == 0 || r->axis->pairs || (r->at >= r->axis->low && r->at < r->axis->points - r->axis->high);
}
/* A row of n nodes, by any taps, to out[i]. */
void pm_difference_any(const struct pm_difference_row *r, size_t n, bool add, double *out);
/* So many rows of n nodes, one behind the other, that have the same taps. */
struct pm_difference_block {
	size_t n, rows;
	bool past;           /* write past the caches */
	const double *ahead; /* as many numbers, to be prefetched, or NULL; where past */
	size_t low, high;    /* set by pm_difference_sum: ends of rows that have taps of their own */
};

/* The sum of one to three terms, all regular, as pm_difference_any would add them, in registers. False if a value is not finite; perhaps also where it would be
 * infinite if rows went on into each other. */
enum { PM_DIFFERENCE_LEAST = 24 }; /* nodes of a row: lines of the cache and vectors fit between its ends */
bool pm_difference_sum(int terms, const struct pm_difference_row *r, struct pm_difference_block b, double *out);

#endif
