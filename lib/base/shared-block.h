/* Blocks of memory that processes hand to each other: a block is a file in memory that each of them maps, with the number of its uses in front. Whoever has the
 * only use may write. A block that nobody uses is taken again by the process that made it. Linux; elsewhere there are none.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_BASE_SHARED_BLOCK_H
#define PM_BASE_SHARED_BLOCK_H

#include "base/base.h"

struct pm_shared {
	uint64_t id; /* below 2^48, the same in all processes */
	void *data;  /* 64-byte aligned; pages of 2 MiB where the system has them for such files */
	size_t bytes;
	int fd;
};

struct pm_shared *pm_shared_new(size_t bytes);        /* with one use; NULL, without a message: there is none to be had */
void pm_shared_use(struct pm_shared *b);              /* one more; it may be another process that will give it up */
void pm_shared_drop(struct pm_shared *b);             /* one less; b may be gone */
bool pm_shared_alone(const struct pm_shared *b);      /* there is one use */
bool pm_shared_left(const struct pm_shared *b);       /* its maker has ended or will not take it again: processes forget it once it has no use */
struct pm_shared *pm_shared_known(uint64_t id);       /* one that is mapped here; NULL: it is not */
struct pm_shared *pm_shared_map(uint64_t id, int fd); /* that of another process; fd is closed or kept. NULL and a message: it is not such a block */

#endif
