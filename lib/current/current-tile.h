/* Esirkepov's current of the ways in one tile. Private to lib/current.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CURRENT_TILE_H
#define PM_CURRENT_TILE_H

#include "transfer/transfer-tile.h"

/* A record: where the way begins on each axis (u of transfer-axis.h), its signed length [cells], at most 1, on each, the charge, and for each axis above
 * dim charge times velocity times the part of the step. */
static inline int pm_current_values(int dim) { return dim + 1 + (3 - dim); } /* beside the place */

struct pm_current_tile {
	const struct pm_kernel *kernel;
	double shift;          /* of the axes */
	size_t cell[3];        /* the first of the tile */
	size_t count;          /* records */
	int stride;
	const double *records;
	double *block[3];      /* one a component, added to; of the axes below dim in units of charge times cells */
};

typedef void pm_current_loop(const struct pm_current_tile *t);
pm_current_loop *pm_current_deposit(int dim, const struct pm_kernel *k);

#endif
