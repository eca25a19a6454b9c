/* The data of fields on their way from a process to the one that made it, in memory that both have, beside the pipe with everything else: copied nowhere, and
 * in so little memory that it stays in the caches. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_PIECE_RING_H
#define PM_STREAM_PIECE_RING_H

#include "stream/wire.h"

struct pm_ring;
struct pm_ring *pm_ring_new(void); /* before fork(); NULL: failure */
void pm_ring_end(struct pm_ring *r, bool writes); /* after it, in each of them */
struct pm_ring *pm_ring_free(struct pm_ring *r);

/* Who writes. room: PM_PIECE bytes for the next piece; NULL: who reads has ended, as has this program unless it ignores SIGPIPE. */
void *pm_ring_room(struct pm_ring *r);
int pm_ring_give(struct pm_ring *r, const void *piece, size_t n); /* copied unless it is in that room */
/* Who reads: the next bytes, at most n, which stay until it is called again; n becomes 0 where the other end has ended. */
int pm_ring_take(struct pm_ring *r, const void **piece, size_t *n);

#endif
