/* A chart as text: points on the 2 x 4 dots of braille letters, or marks of one letter each, where lines must be told apart without colours or braille
 * cannot be shown. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "chart/chart.h"

struct sheet {
	struct pm_chart *c;
	struct pm_chart_print how;
	bool braille;
	int x0, columns, rows;      /* letters before the area, and the area */
	unsigned char *dots;        /* [rows][columns] of braille */
	signed char *owner;         /* the series, -1 none, -2 a guide */
	struct pm_chart_ticks tx, ty;
};

static const char marks_ascii[] = "*+xo#%@&", *const marks[] = {"●", "+", "×", "○", "■", "◆", "▲", "▽"};
static const int terminal_colour[PM_CHART_COLOURS] = {33, 202, 35, 175, 214, 117, 250}; /* the palette among the 256 of terminals, light enough for black */

static int per_column(const struct sheet *s) { return s->braille ? 2 : 1; }
static int per_row(const struct sheet *s) { return s->braille ? 4 : 1; }

static void dot(struct sheet *s, int x, int y, int owner)
{
	static const unsigned char bit[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
	int column = x / per_column(s), row = y / per_row(s);
	if (x < 0 || y < 0 || column >= s->columns || row >= s->rows)
		return;
	int at = row * s->columns + column;
	if (owner < 0 && s->owner[at] >= 0)
		return; /* guides are under the data */
	if (s->braille && owner < 0 && (x + y) % 2)
		return; /* and dotted */
	s->dots[at] |= s->braille ? bit[y % 4][x % 2] : 1;
	s->owner[at] = (signed char)owner;
}

static bool clipped(double a[2], double b[2], const double hi[2])
{
	double t0 = 0, t1 = 1, from[2] = {a[0], a[1]}, delta[2] = {b[0] - a[0], b[1] - a[1]};
	for (int k = 0; k < 4; k++) {
		double p = k & 1 ? delta[k / 2] : -delta[k / 2], q = k & 1 ? hi[k / 2] - from[k / 2] : from[k / 2];
		if (p == 0 && q < 0)
			return false;
		t0 = p < 0 ? fmax(t0, q / p) : t0, t1 = p > 0 ? fmin(t1, q / p) : t1;
	}
	for (int k = 0; k < 2; k++)
		a[k] = from[k] + t0 * delta[k], b[k] = from[k] + t1 * delta[k];
	return t0 <= t1;
}

static void series(struct sheet *s, const struct pm_chart_series *p, int owner)
{
	const double hi[2] = {s->columns * per_column(s) - 1e-6, s->rows * per_row(s) - 1e-6};
	double last[2] = {NAN, NAN};
	for (size_t i = 0; i < p->n; i++) {
		double now[2] = {pm_chart_at(&s->c->x, p->x[i]) * hi[0], (1 - pm_chart_at(&s->c->y, p->y[i])) * hi[1]}, a[2], b[2];
		bool here = !isnan(now[0]) && !isnan(now[1]), line = here && !isnan(last[0]) && p->style != PM_CHART_POINTS;
		memcpy(a, line ? last : now, sizeof a), memcpy(b, now, sizeof b);
		if (here && clipped(a, b, hi)) {
			int steps = (int)ceil(fmax(fabs(b[0] - a[0]), fabs(b[1] - a[1])));
			for (int k = 0; k <= steps; k++) {
				double t = steps ? (double)k / steps : 0;
				dot(s, (int)(a[0] + t * (b[0] - a[0])), (int)(a[1] + t * (b[1] - a[1])), owner);
			}
		}
		last[0] = here ? now[0] : NAN, last[1] = here ? now[1] : NAN;
	}
}

/* ^{...} of a power: 10^-3. */
static void plain(const char *text, char *out)
{
	for (; *text; text++)
		if (*text != '{' && *text != '}')
			*out++ = *text;
	*out = 0;
}

static size_t letters(const char *s)
{
	size_t n = 0;
	for (; *s; s++)
		n += (*s & 0xc0) != 0x80;
	return n;
}

static void colour(const struct sheet *s, FILE *out, int owner)
{
	if (s->how.colours)
		fprintf(out, owner >= 0 ? "\033[38;5;%dm" : owner == -2 ? "\033[90m" : "\033[0m", owner >= 0 ? terminal_colour[owner % PM_CHART_COLOURS] : 0);
}

static void cell(const struct sheet *s, FILE *out, int at)
{
	int owner = s->owner[at];
	if (!s->dots[at])
		fputc(' ', out);
	else if (s->braille) {
		unsigned code = 0x2800u + s->dots[at];
		fprintf(out, "%c%c%c", (int)(0xe0 | code >> 12), (int)(0x80 | ((code >> 6) & 63)), (int)(0x80 | (code & 63)));
	} else if (owner < 0)
		fputs(s->how.ascii ? "." : "·", out);
	else if (s->how.ascii)
		fputc(marks_ascii[owner % 8], out);
	else
		fputs(marks[owner % 8], out);
}

/* A text centred at a place of a line of letters, if nothing is there yet. */
static void put(char *line, int width, double middle, const char *text)
{
	int n = (int)strlen(text), from = (int)(middle - n / 2.0 + 0.5);
	from = from < 0 ? 0 : from + n > width ? width - n : from;
	for (int k = from - 1; k <= from + n; k++)
		if (from < 0 || (k >= 0 && k < width && line[k] != ' '))
			return;
	memcpy(line + from, text, (size_t)n);
}

static void heads(const struct sheet *s, FILE *out)
{
	char text[64];
	if (s->c->title && *s->c->title)
		fprintf(out, "%*s%s\n", s->x0, "", s->c->title);
	plain(s->ty.factor, text);
	if ((s->c->y.label && *s->c->y.label) || *text)
		fprintf(out, "%s%s%s%s\n", s->c->y.label ? s->c->y.label : "", *text ? " (" : "", text, *text ? ")" : "");
	for (size_t k = 0, at = 0; k < s->c->nseries && !s->c->no_legend; k++) {
		const struct pm_chart_series *p = &s->c->series[k];
		size_t width = letters(p->label) + 5;
		if (*p->label) {
			if (!at || (int)(at + width) > s->c->width)
				fprintf(out, "%s%*s", at ? "\n" : "", s->x0 + 1, ""), at = (size_t)s->x0 + 1;
			colour(s, out, p->colour < 0 ? -2 : (int)k);
			fprintf(out, "%s", p->colour < 0 ? s->how.ascii ? ".." : "··" : s->braille ? "⠒⠒" : s->how.ascii ? "" : marks[k % 8]);
			if (p->colour >= 0 && !s->braille && s->how.ascii)
				fputc(marks_ascii[k % 8], out);
			colour(s, out, -1);
			fprintf(out, " %s  ", p->label);
			at += width;
		}
		if (at && k + 1 == s->c->nseries)
			fputc('\n', out);
	}
}

static void body(const struct sheet *s, FILE *out)
{
	char text[64];
	for (int row = 0; row < s->rows; row++) {
		int tick = -1, owner = -1;
		for (int i = 0; i < s->ty.n; i++)
			if ((int)((1 - pm_chart_at(&s->c->y, s->ty.at[i])) * (s->rows - 1e-6)) == row)
				tick = i;
		plain(tick >= 0 ? s->ty.text[tick] : "", text);
		fprintf(out, "%*s%s %s", s->x0 - 2 - (int)letters(text), "", text, s->how.ascii ? tick >= 0 ? "+" : "|" : tick >= 0 ? "┤" : "│");
		int last = s->columns; /* no blanks at the end of a line */
		while (last && !s->dots[row * s->columns + last - 1])
			last--;
		for (int column = 0; column < last; column++) {
			int at = row * s->columns + column;
			if (s->dots[at] && s->owner[at] != owner)
				colour(s, out, owner = s->owner[at]);
			cell(s, out, at);
		}
		if (owner != -1)
			colour(s, out, -1);
		fputc('\n', out);
	}
}

static void feet(const struct sheet *s, FILE *out)
{
	char line[1024], text[256];
	memset(line, ' ', sizeof line);
	fprintf(out, "%*s%s", s->x0 - 1, "", s->how.ascii ? "+" : "└");
	for (int column = 0; column < s->columns; column++) {
		bool tick = false;
		for (int i = 0; i < s->tx.n; i++)
			tick |= (int)(pm_chart_at(&s->c->x, s->tx.at[i]) * (s->columns - 1e-6)) == column;
		fputs(s->how.ascii ? tick ? "+" : "-" : tick ? "┴" : "─", out);
	}
	int width = s->x0 + s->columns < (int)sizeof line ? s->x0 + s->columns : (int)sizeof line - 1;
	for (int i = 0; i < s->tx.n; i++) {
		plain(s->tx.text[i], text);
		put(line, width, s->x0 + floor(pm_chart_at(&s->c->x, s->tx.at[i]) * (s->columns - 1e-6)) + 0.5, text);
	}
	while (width && line[width - 1] == ' ')
		width--;
	fprintf(out, "\n%.*s\n", width, line);
	char factor[64];
	plain(s->tx.factor, factor);
	snprintf(text, sizeof text, "%s%s%s%s", s->c->x.label ? s->c->x.label : "", *factor ? " (" : "", factor, *factor ? ")" : "");
	int lead = s->x0 + (s->columns - (int)letters(text)) / 2;
	if (*text)
		fprintf(out, "%*s%s\n", lead > 0 ? lead : 0, "", text);
}

int pm_chart_print(struct pm_chart *c, FILE *out, struct pm_chart_print how)
{
	size_t data = 0, most = 0;
	for (size_t k = 0; k < c->nseries; k++)
		data += c->series[k].colour >= 0;
	struct sheet s = {.c = c, .how = how, .braille = !how.ascii && (how.colours || data < 2)};
	int above = (c->title && *c->title) + (c->y.label && *c->y.label) + (c->nseries > 1), below = 2 + (c->x.label && *c->x.label);
	s.rows = c->height - above - below < 4 ? 4 : c->height - above - below;
	pm_chart_ticks(&c->y, c->y.names ? s.rows : s.rows / 3, &s.ty);
	for (int i = 0; i < s.ty.n; i++) {
		char text[64];
		plain(s.ty.text[i], text);
		most = letters(text) > most ? letters(text) : most;
	}
	s.x0 = (int)most + 2;
	s.columns = c->width - s.x0 - 1 < 8 ? 8 : c->width - s.x0 - 1;
	pm_chart_ticks(&c->x, s.columns / 10, &s.tx);
	s.dots = pm_zalloc((size_t)s.rows * (size_t)s.columns, 1), s.owner = pm_alloc((size_t)s.rows * (size_t)s.columns, 1);
	int status = s.dots && s.owner ? 0 : -PM_DATA;
	if (!status) {
		memset(s.owner, -1, (size_t)s.rows * (size_t)s.columns);
		for (int d = 0; d < 2; d++)
			for (size_t i = 0; i < c->nlevels[d]; i++) {
				const double at = c->level[d][i].at;
				double x[2] = {d ? c->x.lo : at, d ? c->x.hi : at}, y[2] = {d ? at : c->y.lo, d ? at : c->y.hi};
				struct pm_chart_series line = {.n = 2, .x = x, .y = y};
				series(&s, &line, -2);
			}
		for (size_t k = c->nseries; k-- > 0;)
			series(&s, &c->series[k], c->series[k].colour < 0 ? -2 : (int)k);
		heads(&s, out), body(&s, out), feet(&s, out);
	}
	pm_free(s.dots), pm_free(s.owner);
	return status;
}
