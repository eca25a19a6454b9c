/* How a series is drawn: its line, marks and error bars. Lines of more points than pixels are thinned to the first, lowest, highest and last of each column
 * of pixels. Cost: linear in the points. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "chart/drawing.h"

static const double dashes[4][2] = {{7, 4}, {2.5, 3}, {12, 4}, {5, 8}};

static const unsigned char *colour_of(const struct pm_chart_series *s)
{
	return s->colour < 0 ? pm_chart_guide_ink : pm_chart_palette[s->colour % PM_CHART_COLOURS];
}
double pm_drawing_x(const struct pm_drawing *d, double v) { return d->x0 + pm_chart_at(&d->c->x, v) * (d->x1 - d->x0); }
double pm_drawing_y(const struct pm_drawing *d, double v) { return d->y1 - pm_chart_at(&d->c->y, v) * (d->y1 - d->y0); }

void pm_drawing_piece(struct pm_drawing *d, const double ends[4], double width, const double dash[2], const unsigned char rgb[3])
{
	double xy[2][2] = {{ends[0], ends[1]}, {ends[2], ends[3]}};
	d->k->line(d->k, 2, xy, width, dash, rgb);
}

/* ---- what a series looks like ---- */

bool pm_series_has_lines(const struct pm_chart_series *s) { return s->style != PM_CHART_POINTS; }
bool pm_series_has_marks(const struct pm_chart_series *s)
{
	return s->style == PM_CHART_POINTS || s->style == PM_CHART_BOTH || (s->style == PM_CHART_STEPS && s->n <= 60) ||
		(s->style == PM_CHART_AUTO && s->n <= 60 && s->colour >= 0);
}

/* The corners of the marks with corners, in units of their radius. */
static const struct { size_t n; double xy[4][2]; } corners[] = {{0, {{0}}}, {4, {{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}}},
	{3, {{0, -1.25}, {1.15, 0.8}, {-1.15, 0.8}}}, {4, {{0, -1.3}, {1.3, 0}, {0, 1.3}, {-1.3, 0}}}, {3, {{0, 1.25}, {1.15, -0.8}, {-1.15, -0.8}}}};

static void one_mark(struct pm_drawing *d, int kind, const double at[2], double r, const unsigned char rgb[3])
{
	double xy[4][2], x = at[0], y = at[1], q = kind == 5 ? r : 1.2 * r, s = kind == 5 ? r : 0; /* 5 a cross, 6 the same turned */
	for (size_t i = 0; kind > 0 && kind < 5 && i < corners[kind].n; i++)
		xy[i][0] = x + r * corners[kind].xy[i][0], xy[i][1] = y + r * corners[kind].xy[i][1];
	if (kind > 0 && kind < 5)
		d->k->shape(d->k, corners[kind].n, xy, rgb);
	else if (kind == 5 || kind == 6) {
		pm_drawing_piece(d, (double[4]){x - q, y - s, x + q, y + s}, 0.6 * r, NULL, rgb);
		pm_drawing_piece(d, (double[4]){x + s, y - q, x - s, y + q}, 0.6 * r, NULL, rgb);
	} else
		d->k->disc(d->k, x, y, r, rgb);
}

void pm_series_mark(struct pm_drawing *d, const struct pm_chart_series *s, double x, double y, bool open)
{
	const double r = (s->n > 2000 ? 0.16 : s->n > 300 ? 0.26 : 0.4) * d->letter * (s->thick ? 1.2 : 1), at[2] = {x, y};
	const int kind = s->mark % PM_CHART_MARKS;
	one_mark(d, kind, at, r, colour_of(s));
	if (open || kind == 7) /* one at zero is open: it is not to scale */
		one_mark(d, kind, at, 0.5 * r, pm_chart_paper);
}

static double pen(const struct pm_drawing *d, const struct pm_chart_series *s) { return d->letter * (s->thick ? 0.26 : s->colour < 0 ? 0.13 : 0.18); }

static const double *dash_of(const struct pm_chart_series *s) { return s->dashed ? dashes[s->colour < 0 ? s->mark % 4 : 0] : NULL; }

void pm_series_sample(struct pm_drawing *d, const struct pm_chart_series *s, double x, double y, double length)
{
	if (pm_series_has_lines(s))
		pm_drawing_piece(d, (double[4]){x, y, x + length, y}, pen(d, s), dash_of(s), colour_of(s));
	if (pm_series_has_marks(s))
		pm_series_mark(d, s, x + length / 2, y, false);
}

/* ---- lines, clipped to the area (Liang and Barsky 1984) ---- */

static bool clip(const struct pm_drawing *d, double a[2], double b[2])
{
	double t0 = 0, t1 = 1, delta[2] = {b[0] - a[0], b[1] - a[1]}, lo[2] = {d->x0, d->y0}, hi[2] = {d->x1, d->y1}, from[2] = {a[0], a[1]};
	for (int k = 0; k < 4; k++) {
		double p = k & 1 ? delta[k / 2] : -delta[k / 2], q = k & 1 ? hi[k / 2] - a[k / 2] : a[k / 2] - lo[k / 2];
		if (p == 0 && q < 0)
			return false;
		if (p < 0)
			t0 = fmax(t0, q / p);
		if (p > 0)
			t1 = fmin(t1, q / p);
	}
	for (int k = 0; k < 2; k++)
		b[k] = from[k] + t1 * delta[k], a[k] = from[k] + t0 * delta[k];
	return t0 <= t1;
}

/* A line through n points, cut where it leaves the area or a point is missing. run has room for n + 1. */
static void cut_line(struct pm_drawing *d, const struct pm_chart_series *s, size_t n, double (*xy)[2], double (*run)[2])
{
	size_t m = 0;
	for (size_t i = 0; i <= n; i++) {
		double a[2], b[2];
		bool on = i > 0 && i < n && !isnan(xy[i - 1][0]) && !isnan(xy[i][0]);
		if (on)
			memcpy(a, xy[i - 1], sizeof a), memcpy(b, xy[i], sizeof b);
		on = on && clip(d, a, b);
		if (m && (!on || run[m - 1][0] != a[0] || run[m - 1][1] != a[1])) {
			d->k->line(d->k, m, run, pen(d, s), dash_of(s), colour_of(s));
			m = 0;
		}
		if (!on)
			continue;
		if (!m)
			memcpy(run[m++], a, sizeof a);
		memcpy(run[m++], b, sizeof b);
	}
}

/* Of points in order of x the first, lowest, highest and last in each column of pixels. Returns their number. */
static size_t thin(size_t n, double (*xy)[2])
{
	size_t m = 0;
	for (size_t i = 0; i < n;) {
		size_t e = i, lo = i, hi = i;
		for (; e < n && !isnan(xy[e][0]) && floor(xy[e][0]) == floor(xy[i][0]); e++)
			lo = xy[e][1] < xy[lo][1] ? e : lo, hi = xy[e][1] > xy[hi][1] ? e : hi;
		if (e == i) { /* a gap */
			xy[m][0] = xy[m][1] = NAN;
			m++, i++;
			continue;
		}
		double first[2] = {xy[i][0], xy[i][1]}, last[2] = {xy[e - 1][0], xy[e - 1][1]}, low = xy[lo][1], high = xy[hi][1];
		size_t count = e - i;
		memcpy(xy[m++], first, sizeof first);
		if (count > 3)
			xy[m][0] = first[0], xy[m++][1] = lo < hi ? low : high, xy[m][0] = first[0], xy[m++][1] = lo < hi ? high : low;
		else if (count == 3)
			memmove(xy[m], xy[i + 1], sizeof xy[m]), m++;
		if (count > 1)
			memcpy(xy[m++], last, sizeof last);
		i = e;
	}
	return m;
}

static bool in_order(size_t n, double (*xy)[2])
{
	double last = -HUGE_VAL;
	for (size_t i = 0; i < n; i++)
		if (!isnan(xy[i][0])) {
			if (xy[i][0] < last)
				return false;
			last = xy[i][0];
		}
	return true;
}

/* The points in pixels, those of steps with corners between; their number. NULL: no memory. */
static double (*pixels(const struct pm_drawing *d, const struct pm_chart_series *s, size_t *n))[2]
{
	double (*xy)[2] = pm_alloc(2 * s->n + 2, sizeof *xy);
	*n = 0;
	for (size_t i = 0; xy && i < s->n; i++) {
		double x = pm_drawing_x(d, s->x[i]), y = pm_drawing_y(d, s->y[i]);
		if (isnan(x) || isnan(y) || (s->colour < 0 && pm_chart_at(&d->c->y, s->y[i]) < pm_chart_break(&d->c->y)))
			x = y = NAN; /* a guide ends at the break above the zero */
		if (s->style == PM_CHART_STEPS && *n && !isnan(x) && !isnan(xy[*n - 1][0]))
			xy[*n][0] = x, xy[*n][1] = xy[*n - 1][1], ++*n;
		xy[*n][0] = x, xy[*n][1] = y, ++*n;
	}
	return xy;
}

void pm_series_line(struct pm_drawing *d, const struct pm_chart_series *s)
{
	size_t n;
	double (*xy)[2] = pm_series_has_lines(s) ? pixels(d, s, &n) : NULL, (*run)[2] = xy ? pm_alloc(2 * s->n + 3, sizeof *run) : NULL;
	if (run) {
		if ((double)n > 4 * (d->x1 - d->x0) && in_order(n, xy))
			n = thin(n, xy);
		cut_line(d, s, n, xy, run);
	} else if (pm_series_has_lines(s))
		d->status = -PM_DATA;
	pm_free(xy), pm_free(run);
}

bool pm_drawing_inside(const struct pm_drawing *d, double x, double y) { return x >= d->x0 - 0.5 && x <= d->x1 + 0.5 && y >= d->y0 - 0.5 && y <= d->y1 + 0.5; }

/* The ends of the bar of point i along one axis, x0 y0 x1 y1: on a logarithmic one it may run to the lower edge. false: there is none. */
static bool ends_of_bar(const struct pm_drawing *d, const struct pm_chart_series *s, size_t i, int axis, double bar[4])
{
	const double *half = axis ? s->dy : s->dx, v = axis ? s->y[i] : s->x[i];
	const struct pm_chart_axis *a = axis ? &d->c->y : &d->c->x;
	double at[2] = {pm_drawing_x(d, s->x[i]), pm_drawing_y(d, s->y[i])};
	if (!half || !(half[i] > 0) || (a->log && v <= 0) || isnan(at[0]) || isnan(at[1]) || !pm_drawing_inside(d, at[0], at[1]))
		return false;
	for (int k = 0; k < 2; k++) {
		double e = v + (k ? 1 : -1) * half[i], low = axis ? d->y1 : d->x0;
		double end = a->log && e <= 0 ? low : axis ? pm_drawing_y(d, e) : pm_drawing_x(d, e);
		bar[2 * k] = axis ? at[0] : fmin(fmax(end, d->x0), d->x1);
		bar[2 * k + 1] = axis ? fmin(fmax(end, d->y0), d->y1) : at[1];
	}
	return true;
}

static void error_bar(struct pm_drawing *d, const struct pm_chart_series *s, size_t i, int axis)
{
	const double cap = 0.28 * d->letter, dx = axis ? cap : 0, dy = axis ? 0 : cap, width = 0.1 * d->letter;
	double bar[4];
	if (!ends_of_bar(d, s, i, axis, bar))
		return;
	pm_drawing_piece(d, bar, width, NULL, colour_of(s));
	for (int k = 0; k < 4; k += 2)
		pm_drawing_piece(d, (double[4]){bar[k] - dx, bar[k + 1] - dy, bar[k] + dx, bar[k + 1] + dy}, width, NULL, colour_of(s));
}

void pm_series_points(struct pm_drawing *d, const struct pm_chart_series *s)
{
	for (size_t i = 0; i < s->n; i++) {
		double x = pm_drawing_x(d, s->x[i]), y = pm_drawing_y(d, s->y[i]);
		if (isnan(x) || isnan(y) || !pm_drawing_inside(d, x, y))
			continue;
		bool zero = (d->c->x.log && s->x[i] == 0) || (d->c->y.log && s->y[i] == 0);
		error_bar(d, s, i, 0), error_bar(d, s, i, 1);
		if (pm_series_has_marks(s) || zero)
			pm_series_mark(d, s, x, y, zero);
	}
}

/* ---- room ---- */

void pm_series_take(struct pm_drawing *d, const struct pm_chart_series *s)
{
	double before[2] = {NAN, NAN}, r = 0.5 * d->letter;
	for (size_t i = 0; i < s->n; i++) {
		double a[2], b[2] = {pm_drawing_x(d, s->x[i]), pm_drawing_y(d, s->y[i])}, corner[2] = {b[0], before[1]};
		bool gap = isnan(b[0]) || isnan(b[1]) || isnan(before[0]) || isnan(before[1]) || !pm_series_has_lines(s);
		if (!gap && s->style == PM_CHART_STEPS) {
			memcpy(a, before, sizeof a);
			double to[2] = {corner[0], corner[1]};
			if (clip(d, a, to))
				pm_room_take_line(&d->room, a, to, PM_ROOM_LINE);
			memcpy(before, corner, sizeof before);
		}
		memcpy(a, before, sizeof a), memcpy(before, b, sizeof before);
		if (!gap && clip(d, a, b))
			pm_room_take_line(&d->room, a, b, PM_ROOM_LINE);
		if ((pm_series_has_marks(s) || s->name) && !isnan(before[0]) && !isnan(before[1]))
			pm_room_take(&d->room, (double[4]){before[0] - r, before[1] - r, before[0] + r, before[1] + r}, PM_ROOM_MARK);
		for (int axis = 0; axis < 2; axis++) {
			double bar[4];
			if (ends_of_bar(d, s, i, axis, bar))
				pm_room_take_line(&d->room, bar, bar + 2, PM_ROOM_MARK);
		}
	}
}
