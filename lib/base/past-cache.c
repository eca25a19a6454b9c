/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/past-cache.h"

enum { BLOCK = 4096, ROOM = 8 << 20 }; /* blocks are pages, so that the two ways never share one */

void pm_past_cache_open(struct pm_past_cache *p, int fd)
{
	char self[64];
	snprintf(self, sizeof self, "/proc/self/fd/%d", fd);
	*p = (struct pm_past_cache){.fd = open(self, O_WRONLY | O_DIRECT | O_CLOEXEC), .room = aligned_alloc(BLOCK, ROOM)};
	if (!p->room)
		pm_past_cache_close(p);
}

void pm_past_cache_close(struct pm_past_cache *p)
{
	if (p->fd >= 0)
		close(p->fd);
	free(p->room);
	*p = (struct pm_past_cache){.fd = -1};
}

static int ordinary(int fd, const char *data, size_t n, uint64_t offset)
{
	while (n) {
		const ssize_t k = pwrite(fd, data, n, (off_t)offset);
		if (k < 0 && errno == EINTR)
			continue;
		if (k < 0)
			return -1;
		data += k, n -= (size_t)k, offset += (uint64_t)k;
	}
	return 0;
}

int pm_past_cache_write(struct pm_past_cache *p, int fd, const void *data, size_t n, uint64_t offset)
{
	const char *from = data;
	const size_t ragged = (size_t)(-offset % BLOCK), first = ragged < n ? ragged : n;
	int status = ordinary(fd, from, first, offset);
	size_t done = first;
	while (!status && p->fd >= 0 && n - done >= BLOCK) {
		const size_t most = n - done < ROOM ? n - done : ROOM, k = most - most % BLOCK;
		memcpy(p->room, from + done, k);
		const ssize_t written = pwrite(p->fd, p->room, k, (off_t)(offset + done));
		if (written < 0 && errno == EINTR)
			continue;
		if (written != (ssize_t)k)
			break; /* the ordinary way writes it again, or says why not */
		done += k;
	}
	return status ? status : ordinary(fd, from + done, n - done, offset + done);
}
