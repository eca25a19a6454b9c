/* Series from the columns of a table. SPDX-License-Identifier: GPL-3.0-or-later */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "chart/columns.h"
#include "expression/expression.h"

/* ---- numbers of a row: a column, or an expression over columns ---- */

static double first_number(const struct pm_number_table *t, int column)
{
	for (size_t i = 0; i < t->rows; i++)
		if (!isnan(t->number[(size_t)column * t->rows + i]))
			return t->number[(size_t)column * t->rows + i];
	return NAN;
}

/* NAME is a column, NAME0 its first number. */
static int slot_of(void *context, const char *name)
{
	const struct pm_number_table *t = context;
	size_t n = strlen(name);
	int c = pm_number_table_find(t, name, n);
	if (c < 0 && n > 1 && name[n - 1] == '0' && (c = pm_number_table_find(t, name, n - 1)) >= 0)
		c += (int)t->columns;
	return c + 1;
}

static bool is_name(const char *text)
{
	for (; *text; text++)
		if (!isalnum((unsigned char)*text) && !strchr("_. -", *text))
			return false;
	return true;
}

static int computed(const struct pm_number_table *t, const char *text, double *out)
{
	struct pm_expression *e = pm_alloc(1, sizeof *e);
	double *number = pm_alloc(2 * t->columns + 1, sizeof *number);
	int status = e && number ? pm_expression_compile_numbers(e, slot_of, (void *)t, "column", text) : -PM_DATA;
	if (!status && e->nparts != 1)
		status = pm_fail(PM_USAGE, "'%s' has %d parts, not one", text, e->nparts);
	for (int v = 0; !status && v < e->nvalues; v++)
		if (e->value[v].slot > (int)t->columns)
			number[e->value[v].slot - 1] = first_number(t, e->value[v].slot - 1 - (int)t->columns);
	for (size_t i = 0; !status && i < t->rows; i++) {
		bool gap = false;
		for (int v = 0; v < e->nvalues; v++) {
			int c = e->value[v].slot - 1;
			if (c < (int)t->columns)
				number[c] = t->number[(size_t)c * t->rows + i];
			gap |= isnan(number[c]);
		}
		out[i] = gap ? NAN : pm_expression_number(e, number);
	}
	pm_free(e), pm_free(number);
	return status;
}

/* The place of a word on an axis of words. */
static int word_place(struct pm_chart_axis *a, const char *word, double *place)
{
	size_t i = 0;
	while (i < a->names && strcmp(a->name[i], word))
		i++;
	if (i == a->names) {
		const char **more = realloc((void *)a->name, (i + 1) * sizeof *more);
		if (!more)
			return pm_no_memory();
		more[i] = word, a->name = more, a->names++;
	}
	return *place = (double)i + 1, 0;
}

/* The numbers of every row. axis: of words, if the column has them; NULL: they are an error. */
static int numbers(const struct pm_number_table *t, const char *text, struct pm_chart_axis *axis, double *out)
{
	int c = pm_number_table_find(t, text, strlen(text)), status = 0;
	if (c < 0)
		return is_name(text) ? pm_number_table_lacks(t, text) : computed(t, text, out);
	for (size_t i = 0; i < t->rows && !status; i++) {
		const char *word = t->word[(size_t)c * t->rows + i];
		out[i] = t->number[(size_t)c * t->rows + i];
		if (t->text[c] && *word)
			status = axis ? word_place(axis, word, &out[i]) : pm_fail(PM_DATA, "column '%s' of %s holds words ('%s')", text, t->path, word);
	}
	return status;
}

/* ---- which rows, which series ---- */

static int columns_of(const struct pm_number_table *t, int n, const char *const *name, int column[])
{
	for (int k = 0; k < n; k++) {
		size_t length = strcspn(name[k], "=");
		char only[256];
		snprintf(only, sizeof only, "%.*s", (int)length, name[k]);
		if ((column[k] = pm_number_table_find(t, only, strlen(only))) < 0)
			return pm_number_table_lacks(t, only);
	}
	return 0;
}

static bool wanted(const struct pm_chart_columns *w, const struct pm_number_table *t, const int column[], size_t row)
{
	for (int k = 0; k < w->nwhere; k++) {
		const char *value = w->where[k] + strcspn(w->where[k], "="), *word = t->word[(size_t)column[k] * t->rows + row];
		char *end;
		double x = strtod(value + (*value == '='), &end);
		if (strcmp(value + (*value == '='), word) && (*end || !*value || !(x == t->number[(size_t)column[k] * t->rows + row])))
			return false;
	}
	return true;
}

struct source {
	const struct pm_number_table *t;
	const struct pm_chart_columns *w;
	int by[32], where[32];
	double *x, *y, *dx, *dy;
	const char *file, *column;
};

static char *label_of(const struct source *s, size_t row)
{
	char text[512] = "";
	size_t n = 0;
	if (*s->file)
		n += (size_t)snprintf(text, sizeof text, "%s", s->file);
	if (s->w->ncolumns > 1 || (!*s->file && !s->w->nby))
		n += n < sizeof text ? (size_t)snprintf(text + n, sizeof text - n, "%s%s", n ? ": " : "", s->column) : 0;
	for (int k = 0; k < s->w->nby && n < sizeof text; k++)
		n += (size_t)snprintf(text + n, sizeof text - n, "%s%s", n ? k ? " " : ": " : "", s->t->word[(size_t)s->by[k] * s->t->rows + row]);
	return strdup(text);
}

static bool same_group(const struct source *s, size_t a, size_t b)
{
	for (int k = 0; k < s->w->nby; k++)
		if (strcmp(s->t->word[(size_t)s->by[k] * s->t->rows + a], s->t->word[(size_t)s->by[k] * s->t->rows + b]))
			return false;
	return true;
}

struct pm_chart_series *pm_chart_series_new(struct pm_chart *c, size_t room)
{
	if (!c->series && !(c->series = calloc(PM_CHART_SERIES, sizeof *c->series)))
		return pm_no_memory(), NULL;
	if (c->nseries == PM_CHART_SERIES)
		return pm_fail(PM_DATA, "more than %d lines (choose columns, --where, --by)", PM_CHART_SERIES), NULL;
	struct pm_chart_series *s = &c->series[c->nseries++];
	s->x = pm_alloc(room + 1, sizeof *s->x), s->y = pm_alloc(room + 1, sizeof *s->y);
	return s->x && s->y ? s : NULL;
}

static bool is_gap(const struct source *s, size_t row)
{
	for (size_t c = 0; c < s->t->columns; c++)
		if (*s->t->word[c * s->t->rows + row])
			return false;
	return true;
}

/* The rows of the group of `row` as one series. */
static int group(struct pm_chart *c, const struct source *s, size_t row, bool done[])
{
	const size_t n = s->t->rows;
	struct pm_chart_series *p = pm_chart_series_new(c, n);
	const int name = s->w->name ? pm_number_table_find(s->t, s->w->name, strlen(s->w->name)) : -1;
	if (!p)
		return pm_failed();
	p->label = label_of(s, row), p->style = s->w->style;
	p->mark = (int)(c->nseries - 1);
	p->colour = p->mark % (PM_CHART_COLOURS - 1), p->dashed = p->mark >= PM_CHART_COLOURS - 1; /* black is kept for pm_chart_restyle */
	p->dx = s->dx ? pm_alloc(n + 1, sizeof *p->dx) : NULL, p->dy = s->dy ? pm_alloc(n + 1, sizeof *p->dy) : NULL;
	p->name = name >= 0 ? pm_alloc(n + 1, sizeof *p->name) : NULL;
	if (!p->label || (s->dx && !p->dx) || (s->dy && !p->dy) || (name >= 0 && !p->name))
		return pm_no_memory();
	for (size_t i = row; i < n; i++) {
		bool gap = is_gap(s, i) && p->n; /* between two blocks of rows: in every series that has begun */
		if (!gap && (done[i] || is_gap(s, i) || !same_group(s, row, i) || !wanted(s->w, s->t, s->where, i)))
			continue;
		p->x[p->n] = s->x[i], p->y[p->n] = s->y[i];
		if (p->dx)
			p->dx[p->n] = s->dx[i];
		if (p->dy)
			p->dy[p->n] = s->dy[i];
		if (p->name)
			p->name[p->n] = s->t->word[(size_t)name * n + i];
		p->n++;
		done[i] = !gap;
	}
	return 0;
}

/* One column of y. */
static int add_column(struct pm_chart *c, struct source *s, int k)
{
	const struct pm_chart_columns *w = s->w;
	const size_t n = s->t->rows;
	double *own[2] = {NULL, NULL};
	bool *done = pm_zalloc(n + 1, 1);
	int status = done ? numbers(s->t, w->column[k], &c->y, s->y) : -PM_DATA;
	s->column = w->column[k];
	for (int d = 0; d < 2 && !status; d++) {
		const char *text = d ? (k < w->nerrors ? w->error[k] : "-") : (k < w->nxerrors ? w->xerror[k] : "-");
		if (!strcmp(text, "-"))
			continue;
		status = (own[d] = pm_alloc(n + 1, sizeof(double))) ? numbers(s->t, text, NULL, own[d]) : -PM_DATA;
	}
	s->dx = own[0], s->dy = own[1];
	for (size_t i = 0; i < n && !status; i++) {
		if (!done[i] && !is_gap(s, i) && wanted(w, s->t, s->where, i))
			status = group(c, s, i, done);
	}
	pm_free(done), pm_free(own[0]), pm_free(own[1]);
	return status;
}

const char *pm_chart_x_name(const struct pm_chart_columns *want, const struct pm_number_table *t)
{
	int time = pm_number_table_find(t, "time", 4);
	return want->x ? want->x : t->name[time >= 0 ? time : 0];
}

int pm_chart_add(struct pm_chart *c, const struct pm_chart_columns *want, const struct pm_number_table *t, const char *file)
{
	struct source s = {.t = t, .w = want, .file = file};
	int status = columns_of(t, want->nby, want->by, s.by);
	if (!status)
		status = columns_of(t, want->nwhere, want->where, s.where);
	if (!status && want->name && pm_number_table_find(t, want->name, strlen(want->name)) < 0)
		status = pm_number_table_lacks(t, want->name);
	s.x = pm_alloc(t->rows + 1, sizeof *s.x), s.y = pm_alloc(t->rows + 1, sizeof *s.y);
	if (!status)
		status = s.x && s.y ? numbers(t, pm_chart_x_name(want, t), &c->x, s.x) : -PM_DATA;
	for (int k = 0; k < want->ncolumns && !status; k++)
		status = add_column(c, &s, k);
	pm_free(s.x), pm_free(s.y);
	return status;
}

const char *const pm_chart_styles[] = {"auto", "lines", "points", "both", "steps", NULL};

int pm_chart_restyle(struct pm_chart *c, const struct pm_chart_columns *want)
{
	for (int i = 0; i < want->nstyles; i++) {
		const char *equal = strrchr(want->styles[i], '='), *word = equal ? equal + 1 : "";
		int style = 0;
		while (pm_chart_styles[style] && strcmp(pm_chart_styles[style], word))
			style++;
		if (!equal || !pm_chart_styles[style])
			return pm_fail(PM_USAGE, "--style-of '%s' is not LABEL=lines, points, both or steps", want->styles[i]);
		for (size_t k = 0; k < c->nseries; k++) {
			struct pm_chart_series *s = &c->series[k];
			if (strlen(s->label) != (size_t)(equal - want->styles[i]) || strncmp(s->label, want->styles[i], strlen(s->label)))
				continue;
			s->style = (enum pm_chart_style)style;
			if (s->style == PM_CHART_STEPS)
				s->thick = true, s->dashed = false, s->colour = PM_CHART_COLOURS - 1, s->mark = 0;
		}
	}
	return 0;
}

void pm_chart_free(struct pm_chart *c)
{
	for (size_t k = 0; k < c->nseries; k++) {
		struct pm_chart_series *s = &c->series[k];
		pm_free(s->x), pm_free(s->y), pm_free(s->dx), pm_free(s->dy), pm_free(s->name);
		free(s->label);
	}
	free(c->series);
	free((void *)c->x.name), free((void *)c->y.name);
	c->series = NULL, c->nseries = 0;
}
