/* Loops for the kernel of two linear points in the plane, over particles straight from the stream and over records. Private to lib/transfer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_PLANE_H
#define PM_TRANSFER_TILE_PLANE_H

#include "transfer/tile-cic.h"

/* Are there such loops? */
bool pm_tile_has_plane(int dim, const struct pm_kernel *k);
/* As those of tile-cic.h, to and from the block of t. */
void pm_tile_plane_spread(const struct pm_tile *t, const struct pm_tile_batch *b, const double *q);
void pm_tile_plane_spread_records(const struct pm_tile *t);
bool pm_tile_plane_gather(const struct pm_tile *t, const struct pm_tile_batch *b, const struct pm_tile_results *r);
void pm_tile_plane_gather_records(const struct pm_tile *t);

#endif
