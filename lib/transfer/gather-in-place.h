/* Gather for a pass over particles that stay in the stream and have nearly the order of tiles (tile-runs.h), from a potential whose gradient is left to be
 * made, by cic in a periodic box in space. Private to lib/transfer. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_GATHER_IN_PLACE_H
#define PM_TRANSFER_GATHER_IN_PLACE_H

#include "transfer/order-cache.h"
#include "transfer/tile-results.h"

/* Times factor, to who takes them; the numbers he gets are places in the stream. *done false: it cannot be done with this order of the particles, or would
 * take longer than by tiles. 0 or failure. */
int pm_gather_in_place(const struct pm_transfer *t, const struct pm_order_cache *o, double factor, const struct pm_tile_taker *taker, int threads, bool *done);

#endif
