/* Esirkepov's current in 3-D as sums of cells. Private to lib/transfer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_CURRENT_CELLS_H
#define PM_TRANSFER_CURRENT_CELLS_H

#include "transfer/tile-order.h"

/* Numbers that a cell has, filled up to fours: 3 (width - 1) width^2; 0 where there are no sums of cells (other kernels, other dimensions). The size of a job
 * decides too, so that its bytes are those of any run. */
static inline size_t pm_current_cell_values(int dim, const struct pm_kernel *k)
{
	const bool has = dim == 3 && (k->width == 2 || k->width == 3) && k->degree == k->width - 1 && !k->star;
	return has ? (size_t)(3 * (k->width - 1) * k->width * k->width + 3) / 4 * 4 : 0;
}
/* Particles of a job that are worth them, spread over a whole tile. */
static inline size_t pm_current_cells_least(const struct pm_kernel *k) { return k->width == 2 ? 2048 : 8192; }
enum { PM_CURRENT_CELL_ROWS = PM_TILE_CELLS / 32 }; /* rows of a tile */

/* Ways as arrays: the lower end, the signed length [cells], and the charge. */
struct pm_current_cells {
	const struct pm_kernel *kernel;
	double shift;
	size_t cell[3];          /* the first of the tile */
	size_t count;            /* <= PM_TILE_ORDER_PACK */
	double u[3][PM_TILE_ORDER_PACK], way[3][PM_TILE_ORDER_PACK], q[PM_TILE_ORDER_PACK]; /* as a record of them has them */
	double *sums;            /* [PM_TILE_CELLS][pm_current_cell_values] */
	unsigned char used[PM_CURRENT_CELL_ROWS]; /* rows of cells whose sums are not zero */
};

/* For each thread, at *to: NULL if there are none. 0 or failure. */
int pm_current_cells_new(struct pm_current_cells **to, int threads, int dim, const struct pm_kernel *k);
struct pm_current_cells *pm_current_cells_free(struct pm_current_cells *t);
/* Adds the ways whose ends have the same points; returns how many have not, and their numbers. */
size_t pm_current_cells_add(struct pm_current_cells *t, uint32_t others[PM_TILE_ORDER_PACK]);
/* The sums to the blocks, added; leaves them zero. */
void pm_current_cells_fold(struct pm_current_cells *t, double *const block[3]);

#endif
