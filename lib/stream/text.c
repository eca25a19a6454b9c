/* Frames as text. The header is the JSON of the stream, so nothing is lost; the number of rows is the number
 * of particles of a set (any text tool may delete or insert rows), a mesh must have all its points.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "base/decimal.h"
#include "stream/header.h"
#include "stream/limits.h"
#include "stream/run.h"
#include "stream/text.h"
#include "stream/text-ranks.h"
#include "world/world.h"

static const char frame_mark[] = "#pmpipe ", report_mark[] = "#report ", limits_mark[] = "#limits ", end_mark[] = "#end ";

/* The n-th owner of fields: sets first, then meshes. NULL after the last. */
static const char *owner(const struct pm_frame *f, size_t n, const char **kind)
{
	*kind = n < f->nsets ? "set" : "mesh";
	return n < f->nsets ? f->sets[n]->name : n - f->nsets < f->nmeshes ? f->meshes[n - f->nsets]->name : NULL;
}

static int json_write(FILE *out, const char *mark, const json_t *j)
{
	char *line = j ? pm_json_line(j) : NULL;
	if (!line)
		return pm_fail(PM_DATA, "the header cannot be written as text");
	fprintf(out, "%s%s\n", mark, line);
	free(line);
	return 0;
}

int pm_text_frame_write(FILE *out, struct pm_frame *f)
{
	struct pm_table_column *column = pm_alloc(PM_COLUMNS, sizeof *column);
	json_t *header = pm_header_json(f);
	const char *on, *kind;
	int status = column && header ? json_write(out, frame_mark, header) : -PM_DATA;
	if (!status && json_object_size(f->report))
		status = json_write(out, report_mark, f->report);
	json_t *limits = pm_limits_json(f);
	if (!status && limits)
		status = json_write(out, limits_mark, limits);
	json_decref(limits);
	for (size_t i = 0; !status && (on = owner(f, i, &kind)); i++) {
		int n = pm_table_columns(f, on, column);
		if (n > 0)
			fprintf(out, "#%s %s\n", kind, on);
		status = n < 0 ? n : pm_table_write(out, false, n > 0 ? column[0].field->count : 0, n, column);
	}
	json_decref(header);
	pm_free(column);
	return status;
}

void pm_text_end_write(FILE *out, uint64_t frames) { fprintf(out, "%s%llu\n", end_mark, (unsigned long long)frames); }

static bool starts(struct pm_text *t, const char *mark)
{
	size_t end;
	return !strncmp(pm_text_line(t, t->at, &end), mark, strlen(mark)); /* a newline or a 0 follows */
}

bool pm_text_is_frames(struct pm_text *t) { return starts(t, frame_mark) || starts(t, end_mark); }

/* Parses the JSON after the mark of this line, and goes to the next line. */
static json_t *json_read(struct pm_text *t, const char *mark)
{
	json_error_t why;
	size_t end;
	const char *s = pm_text_line(t, t->at, &end) + strlen(mark);
	json_t *j = json_loadb(s, end - t->at - strlen(mark), JSON_REJECT_DUPLICATES, &why);
	if (!j)
		pm_fail(PM_DATA, "line %lu: the JSON after %sis wrong: %s", (unsigned long)t->line, mark, why.text);
	t->at = end < t->size ? end + 1 : end;
	t->line++;
	return j;
}

static bool is_mark(const char *line)
{
	static const char *const marks[] = {"#pmpipe ", "#report ", "#limits ", "#set ", "#mesh ", "#end ", NULL};
	for (int i = 0; *line == '#' && marks[i]; i++)
		if (!strncmp(line, marks[i], strlen(marks[i])))
			return true;
	return false;
}

int pm_text_frames_index(struct pm_text *t) { return t->ranks ? pm_text_ranks_marks(t, is_mark) : 0; }

/* The next line that starts with one of our marks. */
static size_t table_end(const struct pm_text *t)
{
	if (t->ranks)
		return pm_text_ranks_mark(t, t->at);
	for (const char *s = t->data + t->at; s && (s = memchr(s, '\n', t->size - (size_t)(s - t->data))); s++)
		if (is_mark(s + 1))
			return (size_t)(s + 1 - t->data);
	return t->size;
}

/* Assigns a field to each column; the columns must be exactly those of the header. */
static int match(const struct pm_text *t, int n, struct pm_table_column *column, int nwant, const struct pm_table_column *want)
{
	for (int i = 0; i < n; i++) {
		int k = 0;
		while (k < nwant && strcmp(want[k].name, column[i].name))
			k++;
		for (int j = 0; j < i; j++)
			k = strcmp(column[j].name, column[i].name) ? k : nwant;
		if (k == nwant)
			return pm_fail(PM_DATA, "line %lu: column '%s' is not in the header of its frame, or occurs twice",
				(unsigned long)t->line - 1, column[i].name);
		column[i] = want[k];
	}
	return n == nwant ? 0 : pm_fail(PM_DATA, "line %lu: %d columns, but the header of the frame needs %d", (unsigned long)t->line - 1, n, nwant);
}

static int rows_hold(const struct pm_text *t, struct pm_frame *f, const char *on, size_t rows, uint64_t line)
{
	struct pm_set *set = pm_frame_set(f, on);
	if (set && set->n != rows) {
		int status = pm_frame_set_resize(f, set, rows);
		if (status)
			return status;
	}
	for (size_t i = 0; i < f->nfields; i++) {
		struct pm_field *field = f->fields[i];
		if (strcmp(field->on, on) || field->uniform)
			continue;
		if (field->count != rows)
			return pm_fail(PM_DATA, "line %lu: %zu rows, but the mesh '%s' has %zu points", (unsigned long)line, rows, on, field->count);
		field->use = PM_USE_NEW | PM_USE_FILL;
		if (pm_table_field(t, field) || pm_field_ready(field))
			return -PM_DATA;
		field->use = 0;
	}
	return 0;
}

/* One table: names and rows into the fields of `on`. column: room for twice PM_COLUMNS. */
static int table_read(struct pm_text *t, struct pm_frame *f, const char *on, const char *kind, struct pm_table_column *column)
{
	char mark[PM_NAME + 16];
	size_t rows, end;
	uint64_t line = t->line;
	struct pm_table_column *want = column + PM_COLUMNS;
	int nwant = pm_table_columns(f, on, want), n;
	if (nwant <= 0)
		return nwant;
	size_t length = (size_t)snprintf(mark, sizeof mark, "#%s %s\n", kind, on);
	const char *s = pm_text_line(t, t->at, &end);
	if (t->size - t->at < length || end - t->at + 1 != length || memcmp(s, mark, length))
		return pm_fail(PM_DATA, "line %lu: no table of %s '%s', which the header of the frame needs", (unsigned long)line, kind, on);
	t->at += length, t->line++;
	end = table_end(t);
	n = pm_text_names(t, end, column);
	int status = n < 0 ? n : match(t, n, column, nwant, want);
	status = pm_table_count(status, t, end, &rows);
	status = status ? status : rows_hold(t, f, on, rows, line);
	return pm_table_read(status, t, end, f, n < 0 ? 0 : n, column);
}

static int frame_tables(struct pm_text *t, struct pm_frame *f)
{
	struct pm_table_column *column = pm_alloc(2 * PM_COLUMNS, sizeof *column);
	const char *on, *kind;
	int status = column ? 0 : -PM_DATA;
	if (!status && starts(t, report_mark)) {
		json_t *report = json_read(t, report_mark);
		status = json_is_object(report) ? 0 : report ? pm_fail(PM_DATA, "line %lu: the report is not an object", (unsigned long)t->line - 1) : -PM_DATA;
		json_decref(f->report);
		f->report = report ? report : json_object();
	}
	if (!status && starts(t, limits_mark)) {
		json_t *limits = json_read(t, limits_mark);
		status = limits ? pm_limits_take_all(limits, f) : -PM_DATA;
		json_decref(limits);
	}
	status = t->ranks ? pm_world_agree(status) : status;
	for (size_t i = 0; !status && (on = owner(f, i, &kind)); i++)
		status = table_read(t, f, on, kind, column);
	pm_free(column);
	return status;
}

int pm_text_frame_read(struct pm_text *t, struct pm_frame **f, uint64_t *frames)
{
	while (starts(t, end_mark)) { /* several texts may follow each other */
		int64_t count;
		size_t end;
		if (!pm_integer_read(pm_text_line(t, t->at, &end) + strlen(end_mark), &count) || (uint64_t)count != *frames)
			return pm_fail(PM_DATA, "line %lu: the end line does not count the %lu frames before it",
				(unsigned long)t->line, (unsigned long)*frames);
		t->at = end < t->size ? end + 1 : end, t->line++;
		*frames = 0;
		if (t->at == t->size)
			return 0;
	}
	if (t->at == t->size)
		return pm_fail(PM_DATA, "line %lu: the text stops before its end line (it was cut)", (unsigned long)t->line);
	if (!starts(t, frame_mark))
		return pm_fail(PM_DATA, "line %lu: neither '%s...' nor '%s...'", (unsigned long)t->line, frame_mark, end_mark);
	json_t *header = json_read(t, frame_mark);
	int status = header ? pm_header_frame(header, f) : -PM_DATA;
	json_decref(header);
	status = t->ranks ? pm_world_agree(status) : status;
	if (!status && (status = frame_tables(t, *f)) < 0)
		*f = pm_frame_free(*f);
	++*frames;
	return status < 0 ? status : 1;
}
