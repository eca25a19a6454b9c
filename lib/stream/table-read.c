/* Reads tables of text. The text is split into pieces of about a MiB at line ends; one pass counts their rows, the next reads them, with the first row and
 * line of every piece known, so that any number of threads gives the same fields and the same error: that of the first wrong line.
 * Cost: 20 to 200 ns a number, see lib/base/decimal.c. SPDX-License-Identifier: GPL-3.0-or-later */
#include <ctype.h>
#include <string.h>

#include "base/decimal.h"
#include "stream/csv.h"
#include "stream/table.h"
#include "stream/text-ranks.h"
#include "world/world.h"

static const size_t piece_bytes = 1 << 20;

struct complaint {
	uint64_t line; /* 0: none */
	int column, count;
	enum { COUNT, NUMBER, FINITE, WHOLE, LETTERS, QUOTE, CHANGED } what;
	char token[32];
};

struct piece {
	size_t begin, end, rows; /* rows: of the piece, after the prefix sum of all pieces before it */
	size_t after;            /* rows of all pieces up to this one */
	uint64_t lines;
	bool failed;    /* its text could not be had by one thread of many: the first one tries again, and says why */
	struct complaint wrong;
};

static const char *blanks(const char *s, const char *e)
{
	while (s < e && (*s == ' ' || *s == '\t' || *s == '\r'))
		s++;
	return s;
}

static const char *token_end(const char *s, const char *e)
{
	while (s < e && *s != ' ' && *s != '\t' && *s != '\r')
		s++;
	return s;
}

static bool is_row(const char *s, const char *e)
{
	s = blanks(s, e);
	return s < e && *s != '#';
}

int pm_text_separator(struct pm_text *t)
{
	size_t at = t->at, stop;
	const char *s = pm_text_line(t, at, &stop);
	for (; stop < t->size && !is_row(s, s + (stop - at)); s = pm_text_line(t, at, &stop))
		at = stop + 1;
	const char found = pm_csv_separator(s, s + (stop - at));
	t->csv = found == ',';
	return found == ';' ? pm_fail(PM_DATA, "semicolons separate its columns, but a table has commas, tabs or blanks there (tr ';' ',' where 0.5 has a "
		"point; tr ',;' '.,' where it is written 0,5)") : 0;
}

static int name_add(const struct pm_text *t, struct pm_table_column *column, int n, const char *s, size_t length)
{
	if (n == PM_COLUMNS || !length || length >= PM_NAME || memchr(s, 0, length))
		return pm_fail(PM_DATA, "line %lu: column %d has no name of 1 to 63 letters (at most %d columns)", (unsigned long)t->line - 1, n + 1,
			PM_COLUMNS);
	column[n] = (struct pm_table_column){.component = 0};
	memcpy(column[n].name, s, length);
	return 0;
}

/* The names of a line with commas; a name may be in quotes. */
static int csv_names(const struct pm_text *t, const char *s, const char *e, struct pm_table_column *column)
{
	int n = 0;
	for (struct pm_csv_cell cell; s; n++) {
		s = pm_csv_next(s, e, &cell);
		if (cell.wrong)
			return pm_fail(PM_DATA, "line %lu: the quotes of column %d do not end before a comma", (unsigned long)t->line - 1, n + 1);
		if (name_add(t, column, n, cell.s, (size_t)(cell.e - cell.s)))
			return -PM_DATA;
	}
	return n;
}

int pm_text_names(struct pm_text *t, size_t end, struct pm_table_column *column)
{
	for (int n = 0; t->at < end;) {
		size_t stop;
		const char *s = pm_text_line(t, t->at, &stop), *e = s + (stop - t->at);
		t->at = stop < t->size ? stop + 1 : stop;
		t->line++;
		if (!is_row(s, e))
			continue;
		if (t->csv)
			return csv_names(t, s, e, column);
		for (s = blanks(s, e); s < e; s = blanks(s, e)) {
			const char *stop_name = token_end(s, e);
			if (name_add(t, column, n++, s, (size_t)(stop_name - s)))
				return -PM_DATA;
			s = stop_name;
		}
		return n;
	}
	return 0;
}

/* ---- rows ---- */

static struct piece *pieces_new(struct pm_text *t, size_t at, size_t end, size_t *n)
{
	size_t most = (end - at) / piece_bytes + 1;
	struct piece *p = pm_zalloc(most, sizeof *p);
	for (*n = 0; p && *n < most && at < end;) {
		size_t stop = end - at > piece_bytes ? pm_text_line_end(t, at + piece_bytes) + 1 : end;
		p[*n].begin = at;
		p[(*n)++].end = at = stop < end ? stop : end;
	}
	return p;
}

/* The text of a piece; *own: to be freed. NULL: failure. */
static const char *piece_text(const struct pm_text *t, const struct piece *p, char **own)
{
	*own = t->ranks ? pm_text_ranks_piece(t, p->begin, p->end) : NULL;
	return t->ranks ? *own : t->data + p->begin;
}

static bool piece_count(const struct pm_text *t, struct piece *p)
{
	char *own;
	const char *text = piece_text(t, p, &own);
	for (const char *s = text, *stop = text ? text + (p->end - p->begin) : NULL; s < stop;) {
		const char *e = memchr(s, '\n', (size_t)(stop - s));
		e = e ? e : stop;
		p->rows += is_row(s, e);
		p->lines++;
		s = e + 1;
	}
	pm_free(own);
	return text;
}

/* Counts the rows and lines of all pieces from `at` on and computes the prefix sums. */
static struct piece *pieces_counted(struct pm_text *t, size_t at, size_t end, size_t *n, size_t *rows, uint64_t *lines)
{
	struct piece *p = pieces_new(t, at, end, n);
	*rows = 0, *lines = 0;
	if (!p)
		return NULL;
#pragma omp parallel for schedule(dynamic)
	for (size_t i = 0; i < *n; i++)
		p[i].failed = !piece_count(t, p + i);
	for (size_t i = 0; i < *n; i++) {
		if (p[i].failed && !piece_count(t, p + i))
			return pm_free(p);
		size_t r = p[i].rows;
		uint64_t l = p[i].lines;
		p[i].rows = *rows, p[i].lines = *lines;
		*rows += r, *lines += l;
		p[i].after = *rows;
	}
	return p;
}

/* The pieces that are read here. *first: the row before them, of all ranks; rows and lines: of all. */
static int pieces_here(int status, struct pm_text *t, size_t end, struct piece **p, size_t *n, size_t *rows, uint64_t *line, uint64_t *lines)
{
	size_t at = t->at, first = 0;
	*rows = 0, *lines = 0, *line = 0;
	if (t->ranks && !status)
		pm_text_ranks_share(t, &at, &end);
	*p = status ? NULL : pieces_counted(t, at, end, n, rows, lines);
	status = status ? status : *p ? 0 : pm_failed();
	return t->ranks ? pm_text_ranks_count(status, t, rows, lines, &first, line) : status;
}

int pm_table_count(int status, struct pm_text *t, size_t end, size_t *rows)
{
	size_t n;
	uint64_t line, lines;
	struct piece *p;
	status = pieces_here(status, t, end, &p, &n, rows, &line, &lines);
	pm_free(p);
	return status;
}

int pm_table_field(const struct pm_text *t, struct pm_field *field) { return t->ranks ? pm_text_ranks_field(t, field) : 0; }

/* Stores letters in the components of a row. %41 encodes a letter that a table cannot contain (a blank, # or %), a single % is the empty name. */
static bool letters(const struct pm_field *field, size_t row, const char *s, const char *e)
{
	unsigned char *y = pm_out_u8((struct pm_field *)(uintptr_t)field, 0), one;
	int c = 0;
	if (e - s == 1 && *s == '%')
		s = e;
	for (; s < e && c < field->components; c++) {
		bool coded = *s == '%' && e - s > 2 && isxdigit((unsigned char)s[1]) && isxdigit((unsigned char)s[2]);
		one = (unsigned char)*s;
		if (coded)
			sscanf(s + 1, "%2hhx", &one);
		y[(size_t)c * field->count + row] = one;
		s += coded ? 3 : 1;
	}
	for (; c < field->components; c++)
		y[(size_t)c * field->count + row] = 0;
	return s >= e;
}

/* One value; returns what is wrong with it, or -1. */
static int value_read(const struct pm_table_column *c, size_t row, const char *s, const char *e)
{
	size_t length = (size_t)(e - s);
	double x;
	int64_t k;
	if (c->text)
		return letters(c->field, row, s, e) ? -1 : LETTERS;
	if (c->field->type == PM_I64 || c->field->type == PM_U8) {
		if (pm_integer_read(s, &k) != length || (c->field->type == PM_U8 && (k < 0 || k > 255)))
			return WHOLE;
		if (c->field->type == PM_U8)
			pm_out_u8(c->field, c->component)[row] = (unsigned char)k;
		else
			pm_out_i64(c->field, c->component)[row] = k;
		return -1;
	}
	if (pm_decimal_read(s, &x) != length)
		return NUMBER;
	if (c->field->type == PM_F32)
		x = (float)x;
	pm_out(c->field, c->component)[row] = x;
	return isfinite(x) ? -1 : FINITE;
}

static bool bad(struct complaint *wrong, int what, int column, const char *s, const char *stop)
{
	size_t length = (size_t)(stop - s) < sizeof wrong->token ? (size_t)(stop - s) : sizeof wrong->token - 1;
	wrong->what = what, wrong->column = column;
	for (size_t k = 0; k < length; k++)
		wrong->token[k] = isprint((unsigned char)s[k]) ? s[k] : '?';
	return false;
}

/* Letters as they are; "" is one " within quotes. */
static bool csv_letters(const struct pm_field *field, size_t row, const struct pm_csv_cell *cell)
{
	unsigned char *y = pm_out_u8((struct pm_field *)(uintptr_t)field, 0);
	int c = 0;
	const char *s = cell->s;
	for (; s < cell->e && c < field->components; s++) {
		y[(size_t)c++ * field->count + row] = (unsigned char)*s;
		s += cell->quoted && *s == '"';
	}
	for (; c < field->components; c++)
		y[(size_t)c * field->count + row] = 0;
	return s >= cell->e;
}

static bool csv_row_read(const char *s, const char *e, int n, const struct pm_table_column *column, size_t row, struct complaint *wrong)
{
	int i = 0;
	for (struct pm_csv_cell cell; s; i++) {
		int what = -1;
		s = pm_csv_next(s, e, &cell);
		if (i < n && column[i].field)
			what = column[i].text ? (csv_letters(column[i].field, row, &cell) ? -1 : LETTERS) : cell.s == cell.e ? NUMBER :
				value_read(column + i, row, cell.s, cell.e);
		if (cell.wrong || what >= 0)
			return bad(wrong, cell.wrong ? QUOTE : what, i < n ? i : n - 1, cell.s, cell.e);
	}
	wrong->what = COUNT, wrong->count = i;
	return i == n;
}

static bool row_read(const char *s, const char *e, int n, const struct pm_table_column *column, size_t row, struct complaint *wrong)
{
	int i = 0;
	for (s = blanks(s, e); s < e; s = blanks(s, e), i++) {
		const char *stop = token_end(s, e);
		int what = i < n && column[i].field ? value_read(column + i, row, s, stop) : -1;
		if (what >= 0)
			return bad(wrong, what, i, s, stop);
		s = stop;
	}
	wrong->what = COUNT, wrong->count = i;
	return i == n;
}

/* line: of the first piece here. False: the text could not be had. */
static bool piece_read(const struct pm_text *t, uint64_t line, int n, const struct pm_table_column *column, struct piece *p)
{
	char *own;
	size_t row = p->rows;
	const char *text = piece_text(t, p, &own);
	line += p->lines;
	for (const char *s = text, *stop = text ? text + (p->end - p->begin) : NULL; s < stop; line++) {
		const char *e = memchr(s, '\n', (size_t)(stop - s));
		e = e ? e : stop;
		const bool more = is_row(s, e) && row == p->after;
		if (more)
			p->wrong.what = CHANGED;
		if (more || (is_row(s, e) && !(t->csv ? csv_row_read : row_read)(s, e, n, column, row++, &p->wrong))) {
			p->wrong.line = line;
			break;
		}
		s = e + 1;
	}
	if (text && row != p->after && !p->wrong.line)
		p->wrong.what = CHANGED, p->wrong.line = line;
	pm_free(own);
	return text;
}

static int changed(void) { return pm_fail(PM_DATA, "the file has changed while it was read"); }

static int complain(const struct complaint *w, int n, const struct pm_table_column *column)
{
	static const char *const why[] = {"", "is not a number", "is not finite", "is not an integer of 64 bits", "has too many letters",
		"has quotes that do not end before a comma"};
	if (w->what == CHANGED)
		return changed();
	if (w->what == COUNT)
		return pm_fail(PM_DATA, "line %lu: %d columns, but the line of names has %d", (unsigned long)w->line, w->count, n);
	return pm_fail(PM_DATA, "line %lu, column %d '%s': '%s' %s", (unsigned long)w->line, w->column + 1, column[w->column].name, w->token, why[w->what]);
}

/* The rows of the pieces here. Of several errors that of the first line is said, whichever rank has it. */
static int pieces_read(const struct pm_text *t, uint64_t line, size_t n, struct piece *p, int ncolumns, const struct pm_table_column *column)
{
#pragma omp parallel for schedule(dynamic)
	for (size_t i = 0; i < n; i++)
		p[i].failed = !piece_read(t, line, ncolumns, column, p + i);
	for (size_t i = 0; i < n; i++) {
		if (p[i].failed && !piece_read(t, line, ncolumns, column, p + i))
			return pm_failed();
		if (p[i].wrong.line) {
			pm_world_place(1, 0, 0, p[i].wrong.line);
			return complain(&p[i].wrong, ncolumns, column);
		}
	}
	return 0;
}

int pm_table_read(int status, struct pm_text *t, size_t end, const struct pm_frame *f, int ncolumns, const struct pm_table_column *column)
{
	size_t n, rows;
	uint64_t line, lines;
	struct piece *p;
	status = pieces_here(status, t, end, &p, &n, &rows, &line, &lines);
	for (int i = 0; i < ncolumns && t->ranks && !status; i++)
		if (column[i].field && column[i].field->count != (n ? p[n - 1].after : 0))
			status = changed();
	status = status ? status : pieces_read(t, t->line + line, n, p, ncolumns, column);
	pm_free(p);
	if (t->ranks)
		status = pm_world_agree(status);
	for (int i = 0; i < ncolumns && t->ranks && !status; i++)
		if (column[i].field && !column[i].component)
			status = pm_text_ranks_settle(status, t, f, column[i].field);
	for (int i = 0; i < ncolumns && t->ranks && status; i++)
		if (column[i].field && !column[i].component)
			pm_text_ranks_field_free(column[i].field);
	t->at = end;
	t->line += lines;
	return status;
}
