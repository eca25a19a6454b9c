/* A table is cut into equal shares of bytes, at ends of lines; rows are counted, read where they are, and cut anew as every field is. Cost: that of the table
 * over the ranks; of a value that changes its rank 8 bytes travel. SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "stream/parts.h"
#include "stream/text-ranks.h"
#include "world/world.h"

enum { window_bytes = 1 << 16, scan_bytes = 1 << 20 };

int pm_text_ranks_open(struct pm_text *t, const char *path)
{
	struct stat st = {0};
	*t = (struct pm_text){.line = 1};
	const int fd = strcmp(path, "-") ? open(path, O_RDONLY | O_CLOEXEC) : -1;
	const bool file = fd >= 0 && !fstat(fd, &st) && S_ISREG(st.st_mode);
	double differ[] = {!file, (double)st.st_size, -(double)st.st_size};
	t->ranks = calloc(1, sizeof *t->ranks);
	const int status = pm_world_largest(t->ranks ? 0 : pm_no_memory(), 3, differ);
	if (status || differ[0] > 0 || differ[1] != -differ[2]) {
		if (fd >= 0)
			close(fd);
		free(t->ranks);
		*t = (struct pm_text){0};
		return status;
	}
	t->ranks->fd = fd;
	t->size = (size_t)st.st_size;
	return 1;
}

void pm_text_ranks_close(struct pm_text *t)
{
	if (t->ranks) {
		close(t->ranks->fd);
		free(t->ranks->mark), free(t->ranks->rows);
		free(t->ranks);
	}
	t->ranks = NULL;
}

static int get(const struct pm_text *t, char *to, size_t at, size_t bytes)
{
	for (size_t done = 0; done < bytes;) {
		const ssize_t k = pread(t->ranks->fd, to + done, bytes - done, (off_t)(at + done));
		if (k < 0 && errno == EINTR)
			continue;
		if (k <= 0)
			return k < 0 ? pm_fail_errno("cannot read") : pm_fail(PM_DATA, "the file has become shorter while it was read");
		done += (size_t)k;
	}
	to[bytes] = 0;
	return 0;
}

char *pm_text_ranks_piece(const struct pm_text *t, size_t begin, size_t end)
{
	char *piece = pm_alloc(end - begin + 1, 1);
	return !piece || !get(t, piece, begin, end - begin) ? piece : pm_free(piece);
}

/* A rank that cannot have a line cannot decide what the others do. */
static void window(struct pm_text *t, size_t at, size_t bytes)
{
	struct pm_text_ranks *r = t->ranks;
	if (bytes >= r->room) {
		pm_free(t->data);
		t->data = pm_alloc(r->room = bytes + 1, 1);
	}
	if (!t->data || get(t, t->data, at, bytes))
		pm_cannot_go_on();
	r->at = at, r->held = bytes;
}

const char *pm_text_ranks_line(struct pm_text *t, size_t at, size_t *end)
{
	const struct pm_text_ranks *r = t->ranks;
	for (size_t bytes = window_bytes;; bytes *= 2) {
		const bool here = at >= r->at && at <= r->at + r->held && t->data;
		const char *s = here ? t->data + (at - r->at) : NULL, *e = here ? memchr(s, '\n', r->at + r->held - at) : NULL;
		if (e || (here && r->at + r->held == t->size)) {
			*end = e ? at + (size_t)(e - s) : t->size;
			return s;
		}
		window(t, at, bytes < t->size - at ? bytes : t->size - at);
	}
}

/* The first beginning of a line at or behind a byte of the text. */
static size_t line_from(struct pm_text *t, size_t low, size_t at, size_t high)
{
	size_t end;
	if (at <= low || at >= high)
		return at <= low ? low : high;
	pm_text_ranks_line(t, at - 1, &end);
	return end + 1 < high ? end + 1 : high;
}

void pm_text_ranks_share(struct pm_text *t, size_t *begin, size_t *end)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank(), low = *begin, high = *end, bytes = high - low;
	*begin = line_from(t, low, low + bytes / ranks * me, high);
	*end = me + 1 == ranks ? high : line_from(t, low, low + bytes / ranks * (me + 1), high);
}

static int mark_add(struct pm_text_ranks *r, size_t at)
{
	if (!(r->nmarks & (r->nmarks + 1))) { /* 0, 1, 3, 7 ... */
		size_t *more = realloc(r->mark, 2 * (r->nmarks + 1) * sizeof *more);
		if (!more)
			return pm_no_memory();
		r->mark = more;
	}
	r->mark[r->nmarks++] = at;
	return 0;
}

static int marks_here(struct pm_text *t, bool (*is)(const char *line))
{
	size_t begin = 0, end = t->size;
	int status = 0;
	pm_text_ranks_share(t, &begin, &end);
	while (begin < end && !status) {
		const size_t stop = line_from(t, begin, begin + scan_bytes, end);
		char *piece = pm_text_ranks_piece(t, begin, stop);
		status = piece ? 0 : pm_failed();
		for (const char *s = piece, *e = piece + (stop - begin); s && s < e && !status; s = (s = memchr(s, '\n', (size_t)(e - s))) ? s + 1 : NULL)
			if (is(s))
				status = mark_add(t->ranks, begin + (size_t)(s - piece));
		pm_free(piece);
		begin = stop;
	}
	return status;
}

int pm_text_ranks_marks(struct pm_text *t, bool (*is)(const char *line))
{
	struct pm_text_ranks *r = t->ranks;
	void *all = NULL;
	size_t bytes = 0;
	int status = marks_here(t, is);
	status = pm_world_gather(status, r->mark, r->nmarks * sizeof *r->mark, &all, &bytes);
	status = pm_world_share(status, 0, &bytes, sizeof bytes);
	size_t *mark = status ? NULL : malloc(bytes + 1);
	status = pm_world_agree(status ? status : mark ? 0 : pm_no_memory());
	if (all && !status)
		memcpy(mark, all, bytes);
	status = pm_world_share(status, 0, mark, bytes);
	pm_free(all), free(r->mark);
	r->mark = mark;
	r->nmarks = status ? 0 : bytes / sizeof *mark;
	return status;
}

size_t pm_text_ranks_mark(const struct pm_text *t, size_t at)
{
	const struct pm_text_ranks *r = t->ranks;
	size_t low = 0, high = r->nmarks; /* marks below low are not beyond it, from high on they are */
	while (low < high) {
		const size_t middle = low + (high - low) / 2;
		if (r->mark[middle] > at)
			high = middle;
		else
			low = middle + 1;
	}
	return low < r->nmarks ? r->mark[low] : t->size;
}

int pm_text_ranks_count(int status, struct pm_text *t, size_t *rows, uint64_t *lines, size_t *first, uint64_t *line)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank();
	uint64_t *from = t->ranks->rows;
	if (!from && !(from = t->ranks->rows = calloc(ranks + 1, sizeof *from)))
		status = status ? status : pm_no_memory();
	int64_t before = (int64_t)*lines, all = before;
	if (from) {
		memset(from, 0, (ranks + 1) * sizeof *from);
		from[me + 1] = *rows;
	}
	status = pm_world_count(status, PM_SUM_OF, ranks + 1, (int64_t *)from);
	status = pm_world_count(status, PM_SUM_BEFORE, 1, &before);
	status = pm_world_count(status, PM_SUM_OF, 1, &all);
	for (size_t r = 0; r < ranks && !status; r++)
		from[r + 1] += from[r];
	if (!status)
		*first = from[me], *rows = from[ranks], *line = (uint64_t)before, *lines = (uint64_t)all;
	return status;
}

int pm_text_ranks_field(const struct pm_text *t, struct pm_field *field)
{
	const size_t bytes = ((size_t)pm_world_size() + 1) * sizeof *t->ranks->rows;
	uint64_t *from = malloc(bytes); /* whoever runs the stage frees it */
	if (!from)
		return pm_no_memory();
	memcpy(from, t->ranks->rows, bytes);
	return pm_field_enter(field, from);
}

void pm_text_ranks_field_free(struct pm_field *field)
{
	free((uint64_t *)(uintptr_t)field->from);
	field->from = NULL;
}

int pm_text_ranks_settle(int status, const struct pm_text *t, const struct pm_frame *f, struct pm_field *field)
{
	uint64_t *to = pm_division_new(t->ranks->rows[pm_world_size()], pm_division_grain(f, field->on));
	status = pm_world_agree(status ? status : to ? 0 : pm_failed());
	if (!status)
		status = pm_field_recut(status, field, t->ranks->rows, to);
	free(to);
	return status;
}
