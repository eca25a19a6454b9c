/* Checksums of the stream: every single bit of a frame, of an end and of an abort is turned over, one at a time, and the reader refuses each.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "check.h"
#include "stream/declare.h"
#include "stream/line.h"
#include "stream/run.h"

enum { most = 8192 };

static struct pm_frame *small(void)
{
	struct pm_frame *f = pm_frame_new(1);
	f->time = 0.3, f->dt = 0.1, f->step = 3;
	pm_frame_set_new(f, "matter", 3);
	struct pm_field *x = pm_makes(f, "matter", "x", 1, PM_STATE), *m = pm_makes(f, "matter", "mass", 1, PM_STATE);
	m->uniform = true, m->value[0] = 0.1;
	pm_frame_ready(f);
	for (int i = 0; i < 3; i++)
		pm_out(x, 0)[i] = 0.1 * i;
	pm_frame_settle(f);
	return f;
}

/* The bytes of a stream of one frame, or of an abort; returns how many. */
static size_t stream_bytes(bool aborted, char bytes[most])
{
	int fd = memfd_create("stream", 0);
	struct pm_writer *w = pm_writer_of_fd(dup(fd));
	struct pm_frame *f = small();
	if (aborted)
		check(!pm_write_abort(w, 3, "p2m: frame 7: the density is not finite"), "an abort is written");
	else
		check(!pm_write_frame(w, f) && !pm_write_end(w), "a stream is written (%s)", pm_message());
	pm_frame_free(f);
	pm_writer_close(w);
	ssize_t n = pread(fd, bytes, most, 0);
	close(fd);
	return n > 0 ? (size_t)n : 0;
}

/* Reads a stream to its end: 0, or the failure. */
static int read_all(const char *bytes, size_t n, bool *aborted)
{
	int fd = memfd_create("stream", 0), got = PM_GOT_FRAME;
	if (pwrite(fd, bytes, n, 0) != (ssize_t)n)
		return -99;
	struct pm_reader *r = pm_reader_of_fd(fd);
	while (got > 0) {
		struct pm_frame *f = NULL;
		got = pm_read_frame(r, &f);
		pm_frame_free(f);
	}
	*aborted = pm_reader_aborted(r);
	pm_reader_close(r);
	return got;
}

/* How many flips of one bit are not refused as damage, with a message of one line. */
static size_t passing(char *bytes, size_t n, size_t *first)
{
	size_t passed = 0;
	for (size_t bit = 0; bit < 8 * n; bit++) {
		bool aborted = false;
		bytes[bit / 8] ^= (char)(1 << bit % 8);
		int got = read_all(bytes, n, &aborted);
		bytes[bit / 8] ^= (char)(1 << bit % 8);
		if (got == -PM_DATA && !aborted && *pm_message() && !strchr(pm_message(), '\n'))
			continue;
		*first = passed++ ? *first : bit;
	}
	return passed;
}

static void unseal(char line[PM_LINE], size_t words)
{
	char *at = line;
	for (; words; words--)
		at = strchr(at + 1, ' ');
	memset(at, ' ', (size_t)(line + PM_LINE - 1 - at));
}

int main(void)
{
	char bytes[most] = "";
	bool aborted;
	size_t first = 0, n = stream_bytes(false, bytes), wrong = passing(bytes, n, &first);
	check(n > 3 * PM_LINE && read_all(bytes, n, &aborted) == 0, "the stream as it is written is read (%zu bytes)", n);
	check(!wrong, "of %zu bits of a stream each is refused that is turned over (%zu are not, the first is bit %zu)", 8 * n, wrong, first);
	char *time = strstr(bytes, "\"time\":0.2");
	check(time != NULL, "the header has the time");
	if (!time)
		return check_done();
	time[9] = '4';
	check(read_all(bytes, n, &aborted) == -PM_DATA && strstr(pm_message(), "checksum of a header"), "another time is refused: %s", pm_message());
	setenv("PM_UNSEALED", "1", 1);
	check(read_all(bytes, n, &aborted) == 0, "and read with PM_UNSEALED=1");
	unsetenv("PM_UNSEALED");
	unseal(bytes, 4);
	check(read_all(bytes, n, &aborted) == 0, "and read where the line has no checksum, as in older versions");
	n = stream_bytes(true, bytes);
	check(read_all(bytes, n, &aborted) == -3 && aborted, "an abort has its code (%s)", pm_message());
	wrong = passing(bytes, n, &first);
	check(!wrong, "of %zu bits of an abort each is refused that is turned over (%zu are not, the first is bit %zu)", 8 * n, wrong, first);
	return check_done();
}
