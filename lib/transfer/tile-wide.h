/* Gather and spread by kernels of three to eight points, as many particles at a time as a register has lanes. Private to lib/transfer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_WIDE_H
#define PM_TRANSFER_TILE_WIDE_H

#include "transfer/tile-cic.h"

/* The loops over records, by components or over the nodes of a tile, woven (tile-vector.h); NULL: not for this kernel, or a register holds too little. */
pm_tile_loop *pm_tile_spread_wide(int dim, const struct pm_kernel *k);
pm_tile_loop *pm_tile_gather_wide(int dim, const struct pm_kernel *k);
pm_tile_loop *pm_tile_gather_woven(const struct pm_kernel *k);
/* The same over particles straight from the stream, as those of tile-cic.h, to and from the block of t; NULL as above. */
pm_tile_spread_loop *pm_tile_spread_wide_batch(int dim, const struct pm_kernel *k);
pm_tile_gather_loop *pm_tile_gather_wide_batch(int dim, const struct pm_kernel *k);

#endif
