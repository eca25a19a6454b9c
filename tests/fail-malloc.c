/* An object for LD_PRELOAD that lets memory run out: call number FAIL_AT of malloc, calloc, realloc, aligned_alloc and posix_memalign fails
 * (strdup, fopen and others of libc call malloc), with FAIL_ON every one from there on. FAIL_AT=0: none. With FAIL_COUNT=FILE the number
 * of calls is appended there when a process ends. Calls are counted from the constructors of the program on, in every process by itself.
 * Built and used by tests/fail-malloc.py (glibc only). SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

extern void *__libc_malloc(size_t bytes), *__libc_calloc(size_t n, size_t size), *__libc_realloc(void *old, size_t bytes),
	*__libc_memalign(size_t align, size_t bytes);

static atomic_ulong calls;
static unsigned long fail_at;
static int from_there_on, counting;

__attribute__((constructor)) static void start(void)
{
	const char *at = getenv("FAIL_AT");
	fail_at = at ? strtoul(at, NULL, 10) : 0;
	from_there_on = getenv("FAIL_ON") != NULL;
	counting = 1;
}

__attribute__((destructor)) static void end(void)
{
	const char *path = getenv("FAIL_COUNT");
	char text[32];
	int fd = path ? open(path, O_WRONLY | O_CREAT | O_APPEND, 0666) : -1, n = snprintf(text, sizeof text, "%lu\n", atomic_load(&calls));
	counting = 0;
	if (fd >= 0 && write(fd, text, (size_t)n) == n)
		close(fd);
}

static int fails(void)
{
	if (!counting)
		return 0;
	unsigned long n = atomic_fetch_add(&calls, 1) + 1;
	int now = fail_at && (n == fail_at || (from_there_on && n > fail_at));
	if (now)
		errno = ENOMEM;
	return now;
}

void *malloc(size_t bytes) { return fails() ? NULL : __libc_malloc(bytes); }

void *calloc(size_t n, size_t size) { return fails() ? NULL : __libc_calloc(n, size); }

void *realloc(void *old, size_t bytes) { return fails() ? NULL : __libc_realloc(old, bytes); }

void *aligned_alloc(size_t align, size_t bytes) { return fails() ? NULL : __libc_memalign(align, bytes); }

int posix_memalign(void **out, size_t align, size_t bytes)
{
	void *p = fails() ? NULL : __libc_memalign(align, bytes);
	if (p)
		*out = p;
	return p ? 0 : ENOMEM;
}
