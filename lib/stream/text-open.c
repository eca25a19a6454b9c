/* A text in memory, whole, or where all ranks can read its file (text-ranks.h) line by line. SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include "stream/table.h"
#include "stream/text-ranks.h"

static int text_more(struct pm_text *t, size_t *room)
{
	size_t want = *room ? 2 * *room : (size_t)1 << 20;
	char *data = pm_alloc(want, 1);
	if (!data)
		return -PM_DATA;
	if (t->size)
		memcpy(data, t->data, t->size);
	pm_free(t->data);
	return t->data = data, *room = want, 0;
}

/* Byte order marks that editors write, and that would become part of the first name. */
static int mark_check(const struct pm_text *t, const char *path)
{
	path = strcmp(path, "-") ? path : "standard input";
	if (t->size >= 3 && !memcmp(t->data, "\xEF\xBB\xBF", 3))
		return pm_fail(PM_DATA, "%s: it begins with a byte order mark, three bytes that do not belong to the table (remove them: tail -c +4)", path);
	if (t->size >= 2 && (!memcmp(t->data, "\xFF\xFE", 2) || !memcmp(t->data, "\xFE\xFF", 2)))
		return pm_fail(PM_DATA, "%s: it is UTF-16 (convert it to UTF-8: iconv -f UTF-16 -t UTF-8)", path);
	return 0;
}

int pm_text_open(struct pm_text *t, const char *path)
{
	int fd = strcmp(path, "-") ? open(path, O_RDONLY | O_CLOEXEC) : STDIN_FILENO;
	size_t room = 0;
	ssize_t got = 1;
	*t = (struct pm_text){.line = 1};
	if (fd < 0)
		return pm_fail_errno("cannot open '%s'", path);
	while (got > 0 || (got < 0 && errno == EINTR)) {
		if (t->size + 1 >= room && text_more(t, &room))
			return pm_text_close(t), -PM_DATA;
		got = read(fd, t->data + t->size, room - t->size - 1);
		t->size += got > 0 ? (size_t)got : 0;
	}
	int status = got < 0 ? pm_fail_errno("cannot read '%s'", path) : 0;
	if (fd != STDIN_FILENO)
		close(fd);
	if (!status)
		status = mark_check(t, path);
	if (status)
		return pm_text_close(t), status;
	t->data[t->size] = 0;
	return 0;
}

int pm_text_open_by_ranks(struct pm_text *t, const char *path)
{
	size_t end;
	const int got = pm_text_ranks_open(t, path);
	if (got <= 0)
		return got;
	pm_text_line(t, 0, &end); /* the first bytes are there */
	const int status = mark_check(t, path);
	if (status)
		pm_text_close(t);
	return status ? status : 1;
}

void pm_text_close(struct pm_text *t)
{
	pm_text_ranks_close(t);
	pm_free(t->data);
	*t = (struct pm_text){0};
}

const char *pm_text_line(struct pm_text *t, size_t at, size_t *end)
{
	if (t->ranks)
		return pm_text_ranks_line(t, at, end);
	const char *e = memchr(t->data + at, '\n', t->size - at);
	*end = e ? (size_t)(e - t->data) : t->size;
	return t->data + at;
}

size_t pm_text_line_end(struct pm_text *t, size_t at)
{
	size_t end;
	pm_text_line(t, at, &end);
	return end;
}
