/* Files in memory with a head: id, uses, and whether their maker has left. SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/shared-block.h"

#ifdef __linux__
#include <fcntl.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

enum { most_made = 64, large = 1 << 20, huge = 2 << 20, page = 4096, head_bytes = 64 };

struct head {
	uint64_t id;
	atomic_int uses, left;
};

struct block {
	struct pm_shared is; /* first: callers have its address */
	struct head *head;
	size_t size;         /* of the mapping */
	bool mine;
	struct block *next;
};

static struct block *blocks;
static bool registered; /* leave(), for the end */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static struct block *whole(const struct pm_shared *b) { return (struct block *)(uintptr_t)b; }

/* At a multiple of 2 MiB, where pages may be that large. */
static void *map_aligned(int fd, size_t size)
{
	if (size < huge)
		return mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
	char *room = mmap(NULL, size + huge, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
	if (room == MAP_FAILED)
		return MAP_FAILED;
	char *at = (char *)(((uintptr_t)room + huge - 1) / huge * huge);
	void *p = mmap(at, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED, fd, 0);
	if (at > room)
		munmap(room, (size_t)(at - room));
	munmap(at + size, (size_t)(room + huge - at));
	if (p == MAP_FAILED)
		munmap(at, size);
	else
		madvise(p, size, MADV_HUGEPAGE);
	return p;
}

/* Maps a file and adds it to the list; fd is closed where that fails. Locked. */
static struct block *block_add(int fd, size_t size)
{
	void *p = map_aligned(fd, size);
	struct block *b = p == MAP_FAILED ? NULL : calloc(1, sizeof *b);
	if (!b) {
		if (p != MAP_FAILED)
			munmap(p, size);
		close(fd);
		return NULL;
	}
	b->head = p;
	b->size = size;
	b->is = (struct pm_shared){.data = (char *)p + head_bytes, .bytes = size - head_bytes, .fd = fd};
	b->next = blocks;
	return blocks = b;
}

static void block_remove(struct block **at)
{
	struct block *b = *at;
	*at = b->next;
	munmap(b->head, b->size);
	close(b->is.fd);
	free(b);
}

/* Those that nobody uses and nobody will take again. A message on its way is a use, counted before its sender asks whether the maker has left. */
static void sweep(void)
{
	for (struct block **b = &blocks; *b;)
		if (atomic_load(&(*b)->head->left) && !atomic_load(&(*b)->head->uses))
			block_remove(b);
		else
			b = &(*b)->next;
}

/* No more idle bytes than there are in use, as in memory.c. */
static void idle_trim(void)
{
	size_t used = 0, idle = 0;
	for (struct block *b = blocks; b; b = b->next)
		*(atomic_load(&b->head->uses) ? &used : &idle) += b->mine ? b->size : 0;
	for (struct block *b = blocks; b && idle > used; b = b->next)
		if (b->mine && !atomic_load(&b->head->uses)) {
			atomic_store(&b->head->left, 1);
			idle -= b->size;
		}
	sweep();
}

static size_t size_for(size_t bytes)
{
	const size_t grain = bytes + head_bytes >= large ? huge : page;
	return (bytes + head_bytes + grain - 1) / grain * grain;
}

/* One at most a quarter larger. */
static struct block *made_before(size_t size)
{
	struct block *best = NULL;
	for (struct block *b = blocks; b; b = b->next)
		if (b->mine && b->size >= size && b->size - size <= size / 4 && !atomic_load(&b->head->uses) && (!best || b->size < best->size))
			best = b;
	if (best)
		atomic_store(&best->head->uses, 1); /* no other process has a use, so none can add one */
	return best;
}

/* At the end of this process. */
static void leave(void)
{
	pthread_mutex_lock(&lock);
	for (struct block *b = blocks; b; b = b->next)
		if (b->mine)
			atomic_store(&b->head->left, 1);
	pthread_mutex_unlock(&lock);
}

static struct block *make(size_t size)
{
	int made = 0;
	for (struct block *b = blocks; b; b = b->next)
		made += b->mine;
	uint64_t id;
	const bool may = made < most_made && getrandom(&id, sizeof id, 0) == sizeof id;
	int fd = may ? memfd_create("pmpipe", MFD_CLOEXEC | MFD_ALLOW_SEALING) : -1;
	if (fd < 0)
		return NULL;
	if (ftruncate(fd, (off_t)size) || fcntl(fd, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL)) {
		close(fd);
		return NULL;
	}
	struct block *b = block_add(fd, size);
	if (!b)
		return NULL;
	if (!registered)
		registered = !atexit(leave);
	b->mine = true;
	b->is.id = b->head->id = id >> 16 | 1;
	atomic_store(&b->head->uses, 1);
	idle_trim();
	return b;
}

struct pm_shared *pm_shared_new(size_t bytes)
{
	pthread_mutex_lock(&lock);
	struct block *b = bytes < SIZE_MAX / 4 ? made_before(size_for(bytes)) : NULL;
	b = b || bytes >= SIZE_MAX / 4 ? b : make(size_for(bytes));
	pthread_mutex_unlock(&lock);
	return b ? &b->is : NULL;
}

void pm_shared_use(struct pm_shared *b) { atomic_fetch_add(&whole(b)->head->uses, 1); }

void pm_shared_drop(struct pm_shared *b)
{
	pthread_mutex_lock(&lock);
	if (atomic_fetch_sub(&whole(b)->head->uses, 1) == 1 && atomic_load(&whole(b)->head->left))
		sweep();
	pthread_mutex_unlock(&lock);
}

bool pm_shared_alone(const struct pm_shared *b) { return atomic_load(&whole(b)->head->uses) == 1; }

bool pm_shared_left(const struct pm_shared *b) { return atomic_load(&whole(b)->head->left); }

static struct block *find(uint64_t id)
{
	struct block *b = blocks;
	while (b && b->is.id != id)
		b = b->next;
	return b;
}

struct pm_shared *pm_shared_known(uint64_t id)
{
	pthread_mutex_lock(&lock);
	sweep();
	struct block *b = find(id);
	pthread_mutex_unlock(&lock);
	return b ? &b->is : NULL;
}

struct pm_shared *pm_shared_map(uint64_t id, int fd)
{
	const int wanted = F_SEAL_SHRINK | F_SEAL_GROW, seals = fcntl(fd, F_GET_SEALS);
	struct stat st;
	pthread_mutex_lock(&lock);
	sweep(); /* new blocks may come from a process that left its old ones, as where fields grow */
	struct block *b = find(id);
	if (b)
		close(fd);
	else if (seals >= 0 && (seals & wanted) == wanted && !fstat(fd, &st) && st.st_size > head_bytes) /* it cannot shrink below what is mapped */
		b = block_add(fd, (size_t)st.st_size);
	else
		close(fd);
	if (b)
		b->is.id = id;
	pthread_mutex_unlock(&lock);
	if (b && b->head->id == id)
		return &b->is;
	pm_fail(PM_DATA, "the memory that the word before hands over cannot be mapped here (PM_HANDOVER=0 sends copies)");
	return NULL;
}
#else
struct pm_shared *pm_shared_new(size_t bytes) { return (void)bytes, NULL; }
void pm_shared_use(struct pm_shared *b) { (void)b; }
void pm_shared_drop(struct pm_shared *b) { (void)b; }
bool pm_shared_alone(const struct pm_shared *b) { return (void)b, true; }
bool pm_shared_left(const struct pm_shared *b) { return (void)b, false; }
struct pm_shared *pm_shared_known(uint64_t id) { return (void)id, NULL; }
struct pm_shared *pm_shared_map(uint64_t id, int fd) { return (void)id, (void)fd, NULL; }
#endif
