/* Writes past the kernel's cache of files (O_DIRECT), for a file that is waited for: nothing is copied to the cache first, and the disk works from the first
 * byte on. Blocks that are whole go this way, the ends by the ordinary one, as does all where a file system has no such writes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PAST_CACHE_H
#define PM_PAST_CACHE_H

#include <stddef.h>
#include <stdint.h>

enum { PM_PAST_CACHE_LEAST = 1 << 20 }; /* [bytes] fewer gain nothing */

struct pm_past_cache {
	int fd;     /* the file once more; -1: the ordinary way */
	void *room; /* whole blocks on their way */
};

/* fd: a regular file that is open for writing. It cannot fail: without memory or such writes the ordinary way is left. */
void pm_past_cache_open(struct pm_past_cache *p, int fd);
/* n bytes of the file from `offset` on. 0, or -1 with errno. */
int pm_past_cache_write(struct pm_past_cache *p, int fd, const void *data, size_t n, uint64_t offset);
void pm_past_cache_close(struct pm_past_cache *p);

#endif
