/* E and B of a tile as nodes, for many particles of it. Private to lib/transfer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_STAGGERED_NODES_H
#define PM_TRANSFER_STAGGERED_NODES_H

#include "transfer/staggered-tile.h"
#include "transfer/tile-order.h"

enum { PM_STAGGERED_NODES = 32 * PM_BLOCK_MOST }; /* doubles of four copies of two groups of four components */

bool pm_staggered_has_nodes(int dim, const struct pm_kernel *k, int components, const unsigned char (*staggered)[3]);
/* So many particles of a tile with these points are worth nodes: measured in 3-D with cic and tsc. */
static inline size_t pm_staggered_worth_nodes(const size_t slots[3]) { return 2 * slots[0] * slots[1] * slots[2]; }
/* The blocks [6][PM_BLOCK_MOST] as nodes; slots: points of the tile on each axis, those half a cell up included. */
void pm_staggered_weave(int dim, const struct pm_kernel *k, bool lower, const double *blocks, const size_t slots[3], double *nodes);
/* The loop over records of tiles with nodes. */
pm_staggered_loop *pm_staggered_gather_nodes(int dim, const struct pm_kernel *k, bool lower);

/* The same for cic one order lower in space, as cells (staggered-cells.c), for the two above. */
void pm_staggered_fill_cells(const double *blocks, const size_t slots[3], double *cells);
void pm_staggered_gather_cells(const struct pm_staggered_tile *t);

#endif
