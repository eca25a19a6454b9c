/* A pipe counts the bytes of each piece, another the pieces that were taken. SPDX-License-Identifier: GPL-3.0-or-later */
#include "stream/piece-ring.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum { pieces = 4, told_at_once = 2 }; /* told: that they are free again */

struct pm_ring {
	char *memory; /* pieces * PM_PIECE bytes */
	int full[2], empty[2];
	unsigned at, waiting;      /* piece under way; who reads: known to be full; who writes: not known to be empty */
	unsigned taken;            /* who reads: not told yet */
	uint32_t bytes[pieces];    /* who reads: of those waiting, the first is under way */
	size_t done;               /* of it */
};

static char *place(const struct pm_ring *r) { return r->memory + (size_t)r->at * PM_PIECE; }

struct pm_ring *pm_ring_new(void)
{
	struct pm_ring *r = calloc(1, sizeof *r);
	if (!r) {
		pm_no_memory();
		return NULL;
	}
	r->full[0] = r->full[1] = r->empty[0] = r->empty[1] = -1;
	r->memory = mmap(NULL, pieces * (size_t)PM_PIECE, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
	if (r->memory != MAP_FAILED && !pipe2(r->full, O_CLOEXEC) && !pipe2(r->empty, O_CLOEXEC))
		return r;
	pm_fail_errno("cannot share memory with a process");
	return pm_ring_free(r);
}

static void shut(int *fd)
{
	if (*fd >= 0)
		close(*fd);
	*fd = -1;
}

void pm_ring_end(struct pm_ring *r, bool writes)
{
	shut(&r->full[writes ? 0 : 1]);
	if (writes) /* who reads keeps both ends, so that telling one that has ended is no failure */
		shut(&r->empty[1]);
}

struct pm_ring *pm_ring_free(struct pm_ring *r)
{
	if (r) {
		for (int k = 0; k < 2; k++)
			shut(&r->full[k]), shut(&r->empty[k]);
		if (r->memory != MAP_FAILED)
			munmap(r->memory, pieces * (size_t)PM_PIECE);
		free(r);
	}
	return NULL;
}

/* What a pipe holds, at least one byte; 0: the other end has ended. */
static ssize_t look(int fd, void *to, size_t n)
{
	ssize_t k;
	while ((k = read(fd, to, n)) < 0 && errno == EINTR)
		;
	return k;
}

void *pm_ring_room(struct pm_ring *r)
{
	char said[pieces];
	while (r->waiting == pieces) {
		const ssize_t n = look(r->empty[0], said, sizeof said);
		if (n <= 0) {
			raise(SIGPIPE);
			pm_fail(PM_DATA, "cannot write the output: who reads it has ended");
			return NULL;
		}
		r->waiting -= (unsigned)n;
	}
	return place(r);
}

int pm_ring_give(struct pm_ring *r, const void *piece, size_t n)
{
	char *room = pm_ring_room(r);
	const uint32_t bytes = (uint32_t)n;
	if (!room)
		return -PM_DATA;
	if (piece != room)
		memcpy(room, piece, n);
	if (write(r->full[1], &bytes, sizeof bytes) != (ssize_t)sizeof bytes) /* few bytes: all or none */
		return pm_fail_errno("cannot write the output");
	r->at = (r->at + 1) % pieces;
	r->waiting++;
	return 0;
}

/* The piece under way has been taken. */
static void next(struct pm_ring *r)
{
	r->done = 0;
	r->at = (r->at + 1) % pieces;
	memmove(r->bytes, r->bytes + 1, (--r->waiting) * sizeof *r->bytes);
	if (++r->taken < told_at_once)
		return;
	r->taken = write(r->empty[1], "....", r->taken) < 0 ? r->taken : 0;
}

int pm_ring_take(struct pm_ring *r, const void **piece, size_t *n)
{
	if (r->waiting && r->done == r->bytes[0])
		next(r);
	if (!r->waiting) {
		const ssize_t k = look(r->full[0], r->bytes, sizeof r->bytes);
		if (k <= 0)
			return *n = 0, k ? pm_fail_errno("cannot read") : 0;
		r->waiting = (unsigned)k / sizeof *r->bytes;
	}
	if (!r->waiting || r->bytes[0] > PM_PIECE)
		return pm_fail(PM_DATA, "the process that writes the stream is out of order");
	*piece = place(r) + r->done;
	*n = *n < r->bytes[0] - r->done ? *n : r->bytes[0] - r->done;
	r->done += *n;
	return 0;
}
