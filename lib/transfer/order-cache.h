/* The order of particles in one transfer, kept for the next one at the same positions: m2p uses that of p2m. Private to lib/transfer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_ORDER_CACHE_H
#define PM_TRANSFER_ORDER_CACHE_H

#include "transfer/tile-order.h"
#include "stream/frame.h"

struct pm_order_cache {
	struct pm_note note;     /* first member: it may be attached to the field of the positions */
	int holders;             /* beside the one who has it first */
	struct pm_grid grid;     /* what the order depends on, with n and the positions */
	int width, rim;
	bool cut, given[3][2];
	unsigned char staggered[3];
	size_t n;
	struct pm_column x[3];
	struct pm_axis axes[3];
	struct pm_tile_order order;
	struct pm_strays strays;
};

/* NULL with a message. The records carry nvalues values, and have room for at least `room` doubles. assume: as in tile-order.h;
 * who does looks on the way whether it is so. */
struct pm_order_cache *pm_order_cache_new(const struct pm_transfer *t, const unsigned char staggered[3], size_t n, const struct pm_column x[], int nvalues,
	const struct pm_column values[], int room, bool assume);
struct pm_order_cache *pm_order_cache_free(struct pm_order_cache *o); /* when the last of its holders gives it back */
struct pm_order_cache *pm_order_cache_hold(struct pm_order_cache *o);
/* The one attached there, if it belongs to these positions; NULL if none. */
struct pm_order_cache *pm_order_cache_find(const struct pm_transfer *t, const unsigned char staggered[3], size_t n, const struct pm_column x[]);
/* Particles that stay in the stream, none of them a stray. */
static inline bool pm_order_cache_stays(const struct pm_order_cache *o)
{
	return !o->strays.count && !o->order.tile && !o->order.records && !o->order.floats;
}
/* Attaches it there, or frees it if that is not possible. */
void pm_order_cache_leave(const struct pm_transfer *t, struct pm_order_cache *o);

#endif
