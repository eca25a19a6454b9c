/* Aligned memory with huge pages for large blocks, and a small shelf of freed large blocks: a time step asks for the same sizes again and
 * again, and the first touch of fresh pages costs more than most kernels (2.6 GB/s with 4 KiB pages). SPDX-License-Identifier: GPL-3.0-or-later */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "base/base.h"

enum { kept = 1 << 16, large = 1 << 20, huge = 2 << 20, head = 64, shelf_size = 32 }; /* bytes from which blocks go to the shelf, and have huge pages */

struct block {
	size_t bytes; /* of the whole block, this head included */
};

static struct block *shelf[shelf_size];
static pthread_mutex_t shelf_lock = PTHREAD_MUTEX_INITIALIZER;

static struct block *shelf_take(size_t bytes)
{
	struct block *found = NULL;
	pthread_mutex_lock(&shelf_lock);
	for (int i = 0; i < shelf_size && !found; i++)
		if (shelf[i] && shelf[i]->bytes == bytes) {
			found = shelf[i];
			shelf[i] = NULL;
		}
	pthread_mutex_unlock(&shelf_lock);
	return found;
}

/* Puts a block on the shelf; returns the block that has to leave for it (or the block itself), NULL if there was room. */
static struct block *shelf_put(struct block *b)
{
	static int oldest;
	pthread_mutex_lock(&shelf_lock);
	int place = 0;
	while (place < shelf_size && shelf[place])
		place++;
	if (place == shelf_size)
		place = oldest++ % shelf_size;
	struct block *out = shelf[place];
	shelf[place] = b;
	pthread_mutex_unlock(&shelf_lock);
	return out;
}

void *pm_alloc(size_t count, size_t size)
{
	size_t bytes;
	if (__builtin_mul_overflow(count, size, &bytes) || bytes > SIZE_MAX / 2) {
		pm_fail(PM_DATA, "%zu values of %zu bytes are more than memory can hold", count, size);
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
			pm_fail(PM_DATA, "out of memory: %zu bytes wanted", bytes);
			return NULL;
		}
		if (bytes >= large)
			madvise(b, bytes, MADV_HUGEPAGE);
	}
	b->bytes = bytes;
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
	free(b->bytes >= kept ? shelf_put(b) : b);
	return NULL;
}
