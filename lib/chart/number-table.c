/* Reads a table of text: tabs, commas or blanks between the cells. The text is cut into cells where it stands. Cost: 50 ns a cell.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/nearest-name.h"
#include "chart/number-table.h"

enum { most_columns = 4096 };

/* The next cell from *at, ended by a 0; NULL: the line has no more. mark: the separator, ' ' for blanks. */
static char *next_cell(char **at, char mark)
{
	char *s = *at, *to, *from;
	if (!s)
		return NULL;
	while (*s == ' ' || (mark == ' ' && *s == '\t'))
		s++;
	if (mark == ' ' && !*s)
		return *at = NULL;
	if (*s == '"') { /* "" inside is one quote */
		for (to = s, from = s + 1; *from && (*from != '"' || from[1] == '"'); *to++ = *from++)
			from += *from == '"';
		from += *from == '"';
		from += strcspn(from, mark == ' ' ? " \t" : mark == ',' ? "," : "\t");
	} else {
		from = to = s + strcspn(s, mark == ' ' ? " \t" : mark == ',' ? "," : "\t");
		while (mark != ' ' && to > s && to[-1] == ' ')
			to--;
	}
	*at = *from ? from + 1 : NULL;
	*to = 0;
	return s;
}

/* The next line, without its end; NULL at the end of the text. */
static char *next_line(struct pm_text *t)
{
	if (t->at >= t->size)
		return NULL;
	char *line = t->data + t->at;
	size_t end = pm_text_line_end(t, t->at);
	t->data[end] = 0;
	if (end > t->at && t->data[end - 1] == '\r')
		t->data[end - 1] = 0;
	t->at = end + 1, t->line++;
	return line;
}

static bool number_of(const char *cell, double *x)
{
	char *end;
	*x = NAN;
	if (!*cell || !strcmp(cell, "-") || !strcasecmp(cell, "na") || !strcasecmp(cell, "null"))
		return true;
	*x = strtod(cell, &end);
	if (*end)
		*x = NAN;
	return !*end;
}

static char separator(const char *line)
{
	return strchr(line, '\t') ? '\t' : strchr(line, ',') ? ',' : ' ';
}

static const char *blank(const char *line) { return line + strspn(line, " \t"); }

/* At most one more than most_columns, which is too many. */
static size_t cells_of(char *line, char mark, char *cell[most_columns])
{
	size_t n = 0;
	for (char *at = line, *c; n <= most_columns && (c = next_cell(&at, mark)); n++)
		if (n < most_columns)
			cell[n] = c;
	return n;
}

/* Room for `rows` more rows is there after this; the arrays are kept row by row until the end. */
struct rows {
	const char **word;
	size_t n, room;
};

static int row_add(struct rows *r, size_t columns, char *const *cell)
{
	if (r->n == r->room) {
		size_t room = r->room ? 2 * r->room : 1024;
		const char **more = pm_alloc(room * columns, sizeof *more);
		if (!more)
			return -PM_DATA;
		if (r->n)
			memcpy(more, r->word, r->n * columns * sizeof *more);
		pm_free(r->word);
		r->word = more, r->room = room;
	}
	for (size_t c = 0; c < columns; c++)
		r->word[r->n * columns + c] = cell ? cell[c] : "";
	r->n++;
	return 0;
}

/* The names: of the first line, of a comment before it with as many words, or numbers. *line is then the first row, or NULL. */
static int read_names(struct pm_number_table *t, char *mark, char **line)
{
	char *comment = NULL, *copy, *cell[most_columns];
	double x;
	bool words = false;
	while ((*line = next_line(&t->source)) && (!*blank(*line) || *blank(*line) == '#'))
		comment = *blank(*line) ? (char *)blank(*line) + 1 : comment;
	if (!*line)
		return pm_fail(PM_DATA, "%s: no table: it has no line of names (is there an error above?)", t->path);
	if (!strncmp(*line, "PMPIPE/1", 8))
		return pm_fail(PM_DATA, "%s is a stream, not a table (... | diag | splot, or stab --plain)", t->path);
	*mark = separator(*line);
	if (!(copy = t->names = strdup(*line)))
		return pm_no_memory();
	if ((t->columns = cells_of(copy, *mark, cell)) > most_columns)
		return pm_fail(PM_DATA, "%s: more than %d columns (cut -f takes some of them)", t->path, most_columns);
	for (size_t c = 0; c < t->columns; c++)
		words |= !number_of(cell[c], &x);
	if (!(t->name = pm_alloc(t->columns + 1, sizeof *t->name)))
		return -PM_DATA;
	if (!words) { /* "# a b c" before the rows, or 1, 2, 3 */
		char *said[most_columns];
		size_t n = comment ? cells_of(comment, separator(comment), said) : 0;
		free(t->names);
		if (!(t->names = malloc(24 * t->columns + 24)))
			return pm_no_memory();
		for (size_t c = 0; c < t->columns; c++)
			snprintf(t->names + 24 * c, 24, "%zu", c + 1), t->name[c] = n == t->columns ? said[c] : t->names + 24 * c;
	} else {
		for (size_t c = 0; c < t->columns; c++)
			t->name[c] = cell[c];
		*line = next_line(&t->source);
	}
	return 0;
}

static int read_rows(struct pm_number_table *t, char mark, char *line, struct rows *rows)
{
	char *cell[most_columns];
	int status = 0;
	for (; line && !status; line = next_line(&t->source)) {
		if (*blank(line) == '#')
			continue;
		if (!*blank(line)) {
			status = rows->n ? row_add(rows, t->columns, NULL) : 0;
			continue;
		}
		size_t n = cells_of(line, mark, cell), same = 0, words = 0;
		if (n != t->columns)
			return pm_fail(PM_DATA, "%s: line %llu has %zu cells, the first has %zu", t->path, (unsigned long long)t->source.line - 1, n,
				t->columns);
		for (double x; same < n && !strcmp(cell[same], t->name[same]); same++)
			words += !number_of(cell[same], &x);
		status = row_add(rows, n, same == n && words ? NULL : cell); /* the names again: another table behind the first */
	}
	return status;
}

static int by_column(struct pm_number_table *t, const struct rows *rows)
{
	size_t n = t->rows = rows->n;
	t->number = pm_alloc(t->columns * n + 1, sizeof *t->number);
	t->word = pm_alloc(t->columns * n + 1, sizeof *t->word);
	t->text = pm_zalloc(t->columns + 1, sizeof *t->text);
	if (!t->number || !t->word || !t->text)
		return -PM_DATA;
	for (size_t c = 0; c < t->columns; c++) {
		bool words = false, numbers = false;
		for (size_t r = 0; r < n; r++) {
			const char *w = t->word[c * n + r] = rows->word[r * t->columns + c];
			words |= !number_of(w, &t->number[c * n + r]);
			numbers |= !isnan(t->number[c * n + r]);
		}
		t->text[c] = words && !numbers;
	}
	return 0;
}

int pm_number_table_read(struct pm_number_table *t, const char *path)
{
	struct rows rows = {.n = 0};
	char mark, *line;
	*t = (struct pm_number_table){.path = strcmp(path, "-") ? path : "standard input"};
	int status = pm_text_open(&t->source, path);
	if (!status && memchr(t->source.data, 0, t->source.size) && strncmp(t->source.data, "PMPIPE/1", 8))
		status = pm_fail(PM_DATA, "%s is no text", t->path);
	if (!status)
		status = read_names(t, &mark, &line);
	if (!status)
		status = read_rows(t, mark, line, &rows);
	if (!status)
		status = by_column(t, &rows);
	pm_free(rows.word);
	return status;
}

void pm_number_table_free(struct pm_number_table *t)
{
	pm_free(t->number), pm_free(t->word), pm_free(t->text), pm_free(t->name);
	free(t->names);
	pm_text_close(&t->source);
	*t = (struct pm_number_table){.path = NULL};
}

int pm_number_table_find(const struct pm_number_table *t, const char *name, size_t length)
{
	for (size_t c = 0; c < t->columns; c++)
		if (strlen(t->name[c]) == length && !memcmp(t->name[c], name, length))
			return (int)c;
	for (size_t c = 0; c < t->columns; c++)
		if (!strncmp(t->name[c], name, length) && length && (!strncmp(t->name[c] + length, " [", 2) || !strncmp(t->name[c] + length, " (", 2)))
			return (int)c;
	return -1;
}

/* The names, with commas between, as far as there is room. */
static const char *list_of(const struct pm_number_table *t, char *out, size_t room)
{
	size_t n = 0;
	*out = 0;
	for (size_t c = 0; c < t->columns && n < room; c++)
		n += (size_t)snprintf(out + n, room - n, "%s%s", c ? ", " : "", t->name[c]);
	if (n >= room)
		strcpy(out + room - 5, " ...");
	return out;
}

int pm_number_table_lacks(const struct pm_number_table *t, const char *name)
{
	char list[1200], near[160] = "";
	const char *best = NULL;
	int least = 99;
	for (size_t c = 0; c < t->columns; c++)
		best = pm_nearer(name, t->name[c], best, &least);
	if (best)
		snprintf(near, sizeof near, ", did you mean %s?", best);
	return pm_fail(PM_DATA, "%s has no column '%s'%s (it has %s)", t->path, name, near, list_of(t, list, sizeof list));
}

int pm_number_table_choose(const struct pm_number_table *t)
{
	char list[1200];
	return pm_fail(PM_USAGE, "which column? (splot NAME...; %s has %s)", t->path, list_of(t, list, sizeof list));
}
