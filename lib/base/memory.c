/* Aligned memory with huge pages for large blocks, and a small cache of freed large blocks: a time step allocates the same sizes again and again, and the
 * first touch of fresh pages costs more than most kernels (2.6 GB/s with 4 KiB pages). The cache holds 4 MB, or no more bytes than were recently in use at a
 * time, so that a run with changing sizes (one that loses particles) uses at most twice the memory it needs. SPDX-License-Identifier: GPL-3.0-or-later */
#include <malloc.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/base.h"

enum { kept = 1 << 16, large = 1 << 20, huge = 2 << 20, head = 64 }; /* bytes from which blocks go to the shelf, and have huge pages */
enum { shelf_size = 32, spell = 256, spare = 4 << 20 };             /* blocks; requests; bytes that may always be kept */

struct block {
	size_t bytes; /* of the whole block, this head included */
};

/* Freed blocks, the one freed last in front, and the bytes of all blocks from `kept` on: in use, on the shelf. */
static struct block *shelf[shelf_size];
static int shelved;
static size_t alive, idle;
static pthread_mutex_t shelf_lock = PTHREAD_MUTEX_INITIALIZER;

/* The most bytes in use at a time, in this period of `spell` requests and in the one before: the need of the run, which may shrink. */
static size_t most[2];
static int requests;

static void note_use(void)
{
	if (++requests == spell) {
		requests = 0;
		most[1] = most[0];
		most[0] = 0;
	}
	if (alive > most[0])
		most[0] = alive;
}

static struct block *off_shelf(int place)
{
	struct block *b = shelf[place];
	shelved--;
	memmove(shelf + place, shelf + place + 1, (size_t)(shelved - place) * sizeof *shelf);
	idle -= b->bytes;
	return b;
}

/* Removes the oldest blocks from the cache until it has room and holds no more bytes than were recently in use; returns them in out[], and their number. */
static int shelf_trim(struct block *out[shelf_size])
{
	size_t bound = most[0] > most[1] ? most[0] : most[1];
	int n = 0;
	bound = bound > spare ? bound : spare;
	while (shelved && (shelved == shelf_size || idle > bound))
		out[n++] = off_shelf(shelved - 1);
	return n;
}

/* The smallest block of at least this size, of those freed last, and at most a third larger (and rounded to pages): what ranks send each other differs from
 * step to step, and a vector of three takes the place of records of four numbers. */
static struct block *shelf_take(size_t bytes)
{
	const size_t larger = bytes / 3 + (bytes >= large ? huge : 0);
	struct block *found = NULL;
	int best = -1;
	pthread_mutex_lock(&shelf_lock);
	for (int i = 0; i < shelved; i++)
		if (shelf[i]->bytes >= bytes && shelf[i]->bytes - bytes <= larger && (best < 0 || shelf[i]->bytes < shelf[best]->bytes))
			best = i;
	if (best >= 0)
		found = off_shelf(best);
	alive += found ? found->bytes : bytes;
	note_use();
	pthread_mutex_unlock(&shelf_lock);
	return found;
}

static void not_alive(size_t bytes)
{
	pthread_mutex_lock(&shelf_lock);
	alive -= bytes;
	pthread_mutex_unlock(&shelf_lock);
}

static void shelf_put(struct block *b)
{
	struct block *out[shelf_size];
	pthread_mutex_lock(&shelf_lock);
	alive -= b->bytes;
	idle += b->bytes;
	memmove(shelf + 1, shelf, (size_t)shelved++ * sizeof *shelf);
	shelf[0] = b;
	int n = shelf_trim(out);
	pthread_mutex_unlock(&shelf_lock);
	for (int i = 0; i < n; i++)
		free(out[i]);
}

/* Bytes of memory that the machine has; the system grants more than that, and ends the process when they are used. */
static size_t most_memory(void)
{
	const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
	return pages > 0 && page > 0 ? (size_t)pages * (size_t)page : SIZE_MAX;
}

/* What ends the program, once; a second thread waits for that. */
static void (*end_now)(void);
static pthread_mutex_t end_lock = PTHREAD_MUTEX_INITIALIZER;

void pm_memory_end(void (*end)(void)) { end_now = end; }

static int ends(void)
{
	static _Thread_local bool here;
	if (end_now && !here) {
		here = true; /* it may fail again while it says why */
		pthread_mutex_lock(&end_lock);
		end_now();
	}
	return -PM_DATA;
}

int pm_no_memory(void)
{
	pm_fail(PM_DATA, "out of memory");
	return ends();
}

int pm_cannot_go_on(void) { return ends(); }

void *pm_alloc(size_t count, size_t size)
{
	size_t bytes;
	if (__builtin_mul_overflow(count, size, &bytes) || bytes > SIZE_MAX / 2) {
		pm_fail(PM_DATA, "%zu values of %zu bytes are more than memory can hold", count, size);
		return NULL;
	}
	if (bytes > large && bytes > most_memory()) {
		pm_fail(PM_DATA, "%.1f GB of memory wanted at once, and the machine has %.1f GB", (double)bytes / 1e9, (double)most_memory() / 1e9);
		return NULL;
	}
	bytes += head;
	struct block *b = NULL;
	bytes = bytes >= large ? (bytes + huge - 1) / huge * huge : (bytes + 63) / 64 * 64;
	if (bytes >= kept)
		b = shelf_take(bytes);
	if (!b) {
		b = aligned_alloc(bytes >= large ? huge : 64, bytes);
		if (!b) {
			if (bytes >= kept)
				not_alive(bytes);
			pm_fail(PM_DATA, "out of memory: %zu bytes wanted", bytes);
			ends();
			return NULL;
		}
		if (bytes >= large)
			madvise(b, bytes, MADV_HUGEPAGE);
		b->bytes = bytes;
	}
	return (char *)b + head;
}

void *pm_zalloc(size_t count, size_t size)
{
	void *p = pm_alloc(count, size);
	if (p)
		memset(p, 0, count * size);
	return p;
}

void *pm_free(void *p)
{
	if (!p)
		return NULL;
	struct block *b = (struct block *)((char *)p - head);
	if (b->bytes >= kept)
		shelf_put(b);
	else
		free(b);
	return NULL;
}

void pm_memory_release(void)
{
	struct block *out[shelf_size];
	int n = 0;
	pthread_mutex_lock(&shelf_lock);
	while (shelved)
		out[n++] = off_shelf(shelved - 1);
	most[0] = alive, most[1] = 0, requests = 0;
	pthread_mutex_unlock(&shelf_lock);
	for (int i = 0; i < n; i++)
		free(out[i]);
#ifdef __GLIBC__
	malloc_trim(0);
#endif
}

size_t pm_memory_idle(void)
{
	pthread_mutex_lock(&shelf_lock);
	size_t bytes = idle;
	pthread_mutex_unlock(&shelf_lock);
	return bytes;
}
