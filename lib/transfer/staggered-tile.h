/* Gathers of components at several offsets for the particles of one tile. Private to lib/transfer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_STAGGERED_TILE_H
#define PM_TRANSFER_STAGGERED_TILE_H

#include "transfer/transfer-tile.h"

struct pm_staggered_tile {
	const struct pm_kernel *kernel;
	double shift;           /* of the axes */
	const struct pm_kernel *lower; /* NULL, or that of transfer.h */
	size_t cell[3];         /* the first of the tile */
	size_t count;           /* particles */
	int stride;             /* doubles per record */
	const double *records;  /* u of each axis among the nodes first */
	int components;
	const unsigned char (*staggered)[3]; /* of transfer.h */
	const double *block;    /* [components][PM_BLOCK_MOST] */
	double *results;        /* [count][components] */
	const double *nodes, *u[3]; /* in place of block and records (staggered-nodes.h); the results are then [components][PM_TILE_ORDER_PACK] */
};

/* E and B, six components half a cell up as on Yee's mesh. */
bool pm_staggered_is_yee(int dim, int components, const unsigned char (*staggered)[3]);
typedef void pm_staggered_loop(const struct pm_staggered_tile *t);
/* to_lower: a kernel that has a lower one. */
pm_staggered_loop *pm_staggered_gather(int dim, const struct pm_kernel *k, bool to_lower, int components, const unsigned char (*staggered)[3]);

#endif
