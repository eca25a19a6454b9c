/* Esirkepov's current as sums of cells. Private to lib/current.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CURRENT_CELLS_H
#define PM_CURRENT_CELLS_H

#include "transfer/tile-order.h"

/* Numbers of a cell: of a component below dim (width - 1) width^(dim - 1), of one above it width^dim. */
static inline int pm_current_cell_numbers(int dim, int width)
{
	return dim == 3 ? 3 * (width - 1) * width * width : dim == 2 ? 2 * (width - 1) * width + width * width : width - 1 + 2 * width;
}
/* The same filled up to fours; 0 where there are no sums of cells (other kernels: those of a tile would not stay in the cache). The size of a job decides
 * too, so that its bytes are those of any run. */
static inline size_t pm_current_cell_values(int dim, const struct pm_kernel *k)
{
	const bool has = k->width >= 2 && k->width <= (dim == 1 ? 4 : 3) && k->degree == k->width - 1 && !k->star;
	return has ? (size_t)(pm_current_cell_numbers(dim, k->width) + 3) / 4 * 4 : 0;
}
/* Particles of a job that are worth them, spread over a whole tile. */
static inline size_t pm_current_cells_least(const struct pm_kernel *k) { return k->width == 2 ? 2048 : 8192; }
enum { PM_CURRENT_CELL_ROWS = PM_TILE_CELLS / 32 }; /* of a tile: pieces of its rows along x */
enum { PM_CURRENT_CELL_WAYS = PM_TILE_ORDER_PACK + 8 }; /* and one of no charge, behind them */

/* Ways as arrays: where they begin and the signed length [cells] on each axis below dim, the charge, and what it carries along each axis above. */
struct pm_current_cells {
	int dim;
	const struct pm_kernel *kernel;
	size_t cell[3];          /* the first of the tile */
	size_t count;            /* <= PM_TILE_ORDER_PACK */
	double u[3][PM_CURRENT_CELL_WAYS], way[3][PM_CURRENT_CELL_WAYS], q[PM_CURRENT_CELL_WAYS], along[2][PM_CURRENT_CELL_WAYS];
	double *sums;            /* [PM_TILE_CELLS][pm_current_cell_values] */
	unsigned char used[PM_CURRENT_CELL_ROWS]; /* those with sums that are not zero */
};

/* For each thread, at *to: NULL if there are none. 0 or failure. */
int pm_current_cells_new(struct pm_current_cells **to, int threads, int dim, const struct pm_kernel *k);
struct pm_current_cells *pm_current_cells_free(struct pm_current_cells *t);
/* Adds the ways whose ends have the same points, or not on one axis alone, within the tile; returns how many are left, and their numbers. */
size_t pm_current_cells_add(struct pm_current_cells *t, uint32_t others[PM_TILE_ORDER_PACK]);
/* The sums to the blocks, added; leaves them zero. */
void pm_current_cells_fold(struct pm_current_cells *t, double *const block[3]);

#endif
