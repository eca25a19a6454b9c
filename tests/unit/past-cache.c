/* Writes past the kernel's cache (base/past-cache.h): the bytes of the ordinary way, wherever they begin and end, and its failures.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/past-cache.h"
#include "check.h"

enum { room = 20 << 20 };
static unsigned char want[room], got[room], from[room];

static int new_file(const char *directory)
{
	char name[256];
	snprintf(name, sizeof name, "%s/past-cache.XXXXXX", directory);
	const int fd = mkstemp(name);
	if (fd >= 0)
		unlink(name);
	return fd;
}

/* Pieces at random, over each other too, some of them by write() as the lines of a stream are. direct: is it allowed? */
static void pieces(const char *directory, bool direct)
{
	const int fd = new_file(directory);
	bool good = fd >= 0;
	size_t end = 0;
	memset(want, 0, sizeof want);
	struct pm_past_cache past = {.fd = -1};
	if (direct)
		pm_past_cache_open(&past, fd);
	for (int k = 0; k < 40; k++) {
		const size_t most = k % 4 ? 300000 : 9 << 20, n = (size_t)rand() % most, at = (size_t)rand() % (room - most);
		for (size_t i = 0; i < n; i++)
			from[i] = (unsigned char)(rand() >> 7);
		memcpy(want + at, from, n);
		end = end > at + n ? end : at + n;
		if (k % 5 == 4)
			good = good && pwrite(fd, from, n, (off_t)at) == (ssize_t)n;
		else
			good = good && !pm_past_cache_write(&past, fd, from, n, at);
	}
	pm_past_cache_close(&past);
	good = good && lseek(fd, 0, SEEK_END) == (off_t)end && pread(fd, got, end, 0) == (ssize_t)end && !memcmp(got, want, end);
	check(good, "pieces at random, over each other, %s in %s: the bytes of memory", direct ? "past the cache" : "the ordinary way", directory);
	close(fd);
}

/* A limit in the middle of what is written: what is below it is there, and the error is that of the ordinary way. */
static void limit(bool direct)
{
	const int fd = new_file(".");
	const struct rlimit small = {.rlim_cur = 3000001, .rlim_max = RLIM_INFINITY}, none = {.rlim_cur = RLIM_INFINITY, .rlim_max = RLIM_INFINITY};
	struct pm_past_cache past = {.fd = -1};
	if (direct)
		pm_past_cache_open(&past, fd);
	signal(SIGXFSZ, SIG_IGN);
	setrlimit(RLIMIT_FSIZE, &small);
	errno = 0;
	const bool refused = pm_past_cache_write(&past, fd, want, room, 100) == -1 && errno == EFBIG;
	setrlimit(RLIMIT_FSIZE, &none);
	pm_past_cache_close(&past);
	check(refused && lseek(fd, 0, SEEK_END) == 3000001 && pread(fd, got, 2999901, 100) == 2999901 && !memcmp(got, want, 2999901),
		"a file that may not grow further, %s: the error, and all bytes below the limit", direct ? "past the cache" : "the ordinary way");
	close(fd);
}

int main(void)
{
	srand(1);
	for (int direct = 0; direct < 2; direct++) {
		pieces(".", direct);
		pieces("/dev/shm", direct); /* file systems in memory may refuse such writes */
		limit(direct);
	}
	return check_done();
}
