/* A lane is a ring of bytes with one writer and one reader: how many were written and how many read, each counted by one of the two. A rank that will
 * sleep first says for what, then tries its lanes once more, then waits on its bell with the number of rings that it had seen before; one that has written
 * or read looks at what the other waits for after that. So either the sleeper sees the bytes, or the other sees the wish (both are sequentially
 * consistent). A full lane wakes its reader, whatever it waits for: it may be what its writer waits for. Whether a process still lives is asked of a pipe
 * that it alone has open for writing. SPDX-License-Identifier: GPL-3.0-or-later */
#include <fcntl.h>
#include <linux/futex.h>
#include <poll.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include "base/base.h"
#include "world/lanes.h"

enum {
	for_room = 1 << 30,
	from_any = 1 << 29,
	turns = 5,          /* given to the other processes before a rank sleeps */
	patience = 10000000 /* [ns] till a sleeper looks whether the others live */
};

struct pm_lanes {
	int n, rank, *alive;  /* two ends of a pipe for each rank; -1: closed */
	size_t bytes, length; /* of the memory; of a lane, a power of 2 */
	struct bell {
		_Alignas(64) _Atomic uint32_t rings;
		_Atomic uint32_t wish; /* 0: none; from_any and the rank from which something shall come, for_room */
	} *bell;                   /* by rank */
	struct lane {
		_Alignas(64) _Atomic uint64_t written;
		_Alignas(64) _Atomic uint64_t read;
	} *lane;                   /* from * n + to */
	char *data;                /* of all lanes */
};

void pm_lanes_free(struct pm_lanes *l)
{
	for (int i = 0; l && l->alive && i < 2 * l->n; i++)
		if (l->alive[i] >= 0)
			close(l->alive[i]);
	if (l && l->bell)
		munmap(l->bell, l->bytes);
	if (l)
		free(l->alive);
	free(l);
}

struct pm_lanes *pm_lanes_new(int n)
{
	struct pm_lanes *l = calloc(1, sizeof *l);
	const size_t size = (size_t)n;
	if (!l || !(l->alive = malloc(2 * size * sizeof *l->alive))) {
		pm_lanes_free(l);
		pm_no_memory();
		return NULL;
	}
	memset(l->alive, -1, 2 * size * sizeof *l->alive);
	l->n = n;
	l->length = n > 16 ? 8192 : 65536;
	l->bytes = size * sizeof *l->bell + size * size * (sizeof *l->lane + l->length);
	void *memory = mmap(NULL, l->bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
	bool good = memory != MAP_FAILED;
	if (good) {
		l->bell = memory;
		l->lane = (struct lane *)(l->bell + size);
		l->data = (char *)(l->lane + size * size);
	}
	for (int k = 0; good && k < n; k++)
		good = !pipe2(l->alive + 2 * k, O_CLOEXEC | O_NONBLOCK);
	if (good)
		return l;
	pm_fail_errno("cannot join %d ranks (fewer: --ranks, or ulimit -n)", n);
	pm_lanes_free(l);
	return NULL;
}

static void end_close(int *end)
{
	if (*end >= 0)
		close(*end);
	*end = -1;
}

void pm_lanes_keep(struct pm_lanes *l, int rank)
{
	l->rank = rank;
	for (int k = 0; k < l->n; k++)
		end_close(l->alive + 2 * k + (k != rank));
}

static void ring(struct bell *b)
{
	atomic_fetch_add(&b->rings, 1);
	syscall(SYS_futex, &b->rings, FUTEX_WAKE, 1, NULL, NULL, 0);
}

/* Between the place of a number of bytes in a ring and linear memory. */
static void copy(const struct pm_lanes *l, size_t lane, uint64_t at, void *data, size_t bytes, bool out)
{
	char *ring_of = l->data + lane * l->length;
	for (size_t done = 0; done < bytes;) {
		const size_t place = (size_t)(at + done) & (l->length - 1), k = bytes - done < l->length - place ? bytes - done : l->length - place;
		if (out)
			memcpy(ring_of + place, (char *)data + done, k);
		else
			memcpy((char *)data + done, ring_of + place, k);
		done += k;
	}
}

size_t pm_lanes_send(struct pm_lanes *l, int to, const void *data, size_t bytes)
{
	const size_t i = (size_t)(l->rank * l->n + to);
	const uint64_t written = atomic_load_explicit(&l->lane[i].written, memory_order_relaxed);
	const uint64_t room = l->length - (written - atomic_load(&l->lane[i].read));
	const size_t k = bytes < room ? bytes : (size_t)room;
	copy(l, i, written, (void *)(uintptr_t)data, k, true);
	atomic_store(&l->lane[i].written, written + k);
	const uint32_t wish = atomic_load(&l->bell[to].wish);
	if (wish && k && (k < bytes || (wish & from_any && (wish & (from_any - 1)) == (uint32_t)l->rank)))
		ring(l->bell + to);
	return k;
}

size_t pm_lanes_take(struct pm_lanes *l, int from, void *data, size_t bytes)
{
	const size_t i = (size_t)(from * l->n + l->rank);
	const uint64_t read = atomic_load_explicit(&l->lane[i].read, memory_order_relaxed), there = atomic_load(&l->lane[i].written) - read;
	const size_t k = bytes < there ? bytes : (size_t)there;
	if (!k)
		return 0;
	copy(l, i, read, data, k, false);
	atomic_store(&l->lane[i].read, read + k);
	if (atomic_load(&l->bell[from].wish) & for_room)
		ring(l->bell + from);
	return k;
}

uint32_t pm_lanes_rings(struct pm_lanes *l) { return atomic_load(&l->bell[l->rank].rings); }

void pm_lanes_awake(struct pm_lanes *l) { atomic_store(&l->bell[l->rank].wish, 0); }

/* Whether something came from a rank while the other processes of this core had their turn: where there are more ranks than cores that is soon, and
 * cheaper than to sleep and be woken (0.9 s of processor time for 2.1, multigrid on small meshes by 7 ranks on two cores). */
static bool comes(const struct pm_lanes *l, int from)
{
	const struct lane *lane = l->lane + (from * l->n + l->rank);
	for (int i = 0; i < turns; i++) {
		sched_yield();
		if (atomic_load(&lane->written) != atomic_load(&lane->read))
			return true;
	}
	return false;
}

bool pm_lanes_sleep(struct pm_lanes *l, uint32_t rings, int from, bool room)
{
	struct bell *b = l->bell + l->rank;
	const uint32_t wish = (from >= 0 ? from_any | (uint32_t)from : 0) | (room ? for_room : 0);
	if (atomic_load(&b->wish) != wish) {
		if (from < 0 || !comes(l, from))
			atomic_store(&b->wish, wish);
		return false;
	}
	const struct timespec end = {0, patience};
	return syscall(SYS_futex, &b->rings, FUTEX_WAIT, rings, &end, NULL, 0) && pm_lanes_rings(l) == rings;
}

bool pm_lanes_gone(struct pm_lanes *l, int rank)
{
	struct pollfd p = {l->alive[2 * rank], 0, 0};
	return poll(&p, 1, 0) > 0 && p.revents & (POLLHUP | POLLERR);
}
