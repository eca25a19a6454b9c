/* A plot: a picture with axes, ticks, a bar of colours and a title. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "picture/colour.h"
#include "picture/plot.h"

enum { most_ticks = 32 };
static const unsigned char ink[3] = {38, 42, 51}, faint[3] = {120, 126, 138}, paper[3] = {255, 255, 255}, blue[3] = {31, 97, 171}, warm[3] = {255, 214, 150};

int pm_plot_new(struct pm_plot *p, int size, double aspect, const double lo[2], const double hi[2], bool bar, const unsigned char ground[3])
{
	double letter = fmax(7, size / 56.0);
	int w = aspect >= 1 ? size : (int)fmax(40, size * aspect), h = aspect >= 1 ? (int)fmax(40, size / aspect) : size;
	*p = (struct pm_plot){.x0 = (int)(6.2 * letter), .y0 = (int)(3.4 * letter), .letter = letter};
	p->x1 = p->x0 + w, p->y1 = p->y0 + h;
	memcpy(p->lo, lo, sizeof p->lo), memcpy(p->hi, hi, sizeof p->hi);
	int width = p->x1 + (int)((bar ? 9.5 : 2) * letter), height = p->y1 + (int)(5.2 * letter);
	if (pm_picture_new(&p->picture, width + (width & 1), height + (height & 1), paper)) /* even sides, because video encoders need them */
		return -PM_DATA;
	pm_picture_fill(&p->picture, p->x0, p->y0, p->x1, p->y1, ground);
	return 0;
}

void pm_plot_free(struct pm_plot *p) { pm_picture_free(&p->picture); }

double pm_scale_at(const struct pm_scale *s, double value)
{
	if (s->log)
		return value > 0 ? log(value / s->lo) / log(s->hi / s->lo) : -HUGE_VAL;
	return (value - s->lo) / (s->hi - s->lo);
}

/* 193 colours, an odd number so that the middle is one of them; together with those of the letters few enough for a palette. */
static void shade(const struct pm_scale *s, double t, unsigned char rgb[3])
{
	t = fmin(fmax(t, 0), 1);
	if (s->centred)
		t = 0.5 + 0.5 * (s->lo + t * (s->hi - s->lo)) / fmax(fabs(s->lo), fabs(s->hi));
	t = floor(192 * t + 0.5) / 192;
	pm_colour_of(s->map, s->start + (1 - s->start) * t, rgb);
}

static void colour(struct pm_scale *s, double value, unsigned char rgb[3])
{
	double t = pm_scale_at(s, value);
	s->below |= t < -1e-9;
	s->above |= t > 1 + 1e-9;
	shade(s, t, rgb);
}

static double across(const struct pm_plot *p, double x) { return p->x0 + (x - p->lo[0]) / (p->hi[0] - p->lo[0]) * (p->x1 - p->x0); }
static double up(const struct pm_plot *p, double y) { return p->y1 - (y - p->lo[1]) / (p->hi[1] - p->lo[1]) * (p->y1 - p->y0); }

void pm_plot_raster(struct pm_plot *p, const struct pm_raster *r, struct pm_scale *s)
{
	for (int y = p->y0; y < p->y1; y++)
		for (int x = p->x0; x < p->x1; x++) {
			unsigned char rgb[3];
			double u = p->lo[0] + (x + 0.5 - p->x0) / (p->x1 - p->x0) * (p->hi[0] - p->lo[0]), v = p->hi[1] - (y +
				0.5 - p->y0) / (p->y1 - p->y0) * (p->hi[1] - p->lo[1]);
			colour(s, pm_raster_at(r, u, v), rgb);
			pm_picture_blend(&p->picture, x, y, rgb, 1);
		}
}

/* Paints over everything that was drawn beyond the data area. */
static void trim(struct pm_plot *p)
{
	struct pm_picture *q = &p->picture;
	pm_picture_fill(q, 0, 0, q->width, p->y0, paper), pm_picture_fill(q, 0, p->y1, q->width, q->height, paper);
	pm_picture_fill(q, 0, p->y0, p->x0, p->y1, paper), pm_picture_fill(q, p->x1, p->y0, q->width, p->y1, paper);
}

void pm_plot_points(struct pm_plot *p, size_t n, const double *x, const double *y, const double *value, struct pm_scale *s, double radius)
{
	for (size_t i = 0; i < n; i++) {
		unsigned char rgb[3];
		memcpy(rgb, warm, sizeof rgb);
		if (!(x[i] >= p->lo[0] && x[i] <= p->hi[0] && y[i] >= p->lo[1] && y[i] <= p->hi[1]))
			continue;
		if (value)
			colour(s, value[i], rgb);
		pm_picture_disc(&p->picture, across(p, x[i]), up(p, y[i]), radius, rgb, 0.85);
	}
	trim(p);
}

void pm_plot_curve(struct pm_plot *p, size_t n, const double *x, const double *y)
{
	for (size_t i = 1; i < n; i++)
		pm_picture_line(&p->picture, across(p, x[i - 1]), up(p, y[i - 1]), across(p, x[i]), up(p, y[i]), p->letter / 7, blue);
	trim(p);
}

int pm_plot_ticks(double lo, double hi, int most, double *at, double *step)
{
	double raw = (hi - lo) / most, power = pow(10, floor(log10(raw))), left = raw / power;
	int n = 0;
	*step = power * (left <= 1 ? 1 : left <= 2 ? 2 : left <= 5 ? 5 : 10);
	for (double k = ceil(lo / *step - 1e-9); k * *step <= hi + 1e-9 * *step && n < most_ticks; k++)
		at[n++] = k == 0 ? 0 : k * *step;
	return n;
}

/* The number as a label: with as many digits as the distance of the ticks needs. */
static void label(double x, double step, char out[40])
{
	double most = fmax(fabs(x), step);
	int decimals = (int)fmax(0, -floor(log10(step) + 1e-9)), digits = (int)fmin(fmax(floor(log10(most)) - floor(log10(step) + 1e-9) + 1, 1), 15);
	if (most < 99999.5 && decimals <= 4) {
		snprintf(out, 40, "%.*f", decimals, x);
		return;
	}
	snprintf(out, 40, "%.*g", digits, x);
	char *e = strchr(out, 'e');
	if (e) {
		int power = atoi(e + 1);
		snprintf(e, (size_t)(out + 40 - e), "e%d", power);
	}
}

/* Ticks are whole pixels, like the border. */
static int pen(const struct pm_plot *p) { return (int)fmax(1, floor(p->letter / 8)); }

static void axis_x(struct pm_plot *p)
{
	double at[most_ticks], step, l = p->letter;
	char text[40];
	for (int i = 0, n = pm_plot_ticks(p->lo[0], p->hi[0], 7, at, &step); i < n; i++) {
		double x = across(p, at[i]);
		label(at[i], step, text);
		pm_picture_fill(&p->picture, (int)x, p->y1, (int)x + pen(p), p->y1 + (int)(0.5 * l), ink);
		pm_picture_text(&p->picture, x - pm_picture_text(NULL, 0, 0, l, false, text, ink) / 2, p->y1 + 1.9 * l, l, false, text, ink);
	}
}

static void axis_y(struct pm_plot *p)
{
	double at[most_ticks], step, l = p->letter;
	char text[40];
	for (int i = 0, n = pm_plot_ticks(p->lo[1], p->hi[1], 7, at, &step); i < n; i++) {
		double y = up(p, at[i]);
		label(at[i], step, text);
		pm_picture_fill(&p->picture, p->x0 - (int)(0.5 * l), (int)y, p->x0, (int)y + pen(p), ink);
		pm_picture_text(&p->picture, p->x0 - 0.8 * l - pm_picture_text(NULL, 0, 0, l, false, text, ink), y + l / 2, l, false, text, ink);
	}
}

/* Just outside the area, in whole pixels. */
static void border(struct pm_plot *p, int x0, int y0, int x1, int y1)
{
	struct pm_picture *q = &p->picture;
	int w = pen(p);
	pm_picture_fill(q, x0 - w, y0 - w, x1 + w, y0, ink), pm_picture_fill(q, x0 - w, y1, x1 + w, y1 + w, ink);
	pm_picture_fill(q, x0 - w, y0, x0, y1, ink), pm_picture_fill(q, x1, y0, x1 + w, y1, ink);
}

void pm_plot_axes(struct pm_plot *p, const char *xlabel, const char *ylabel, const char *title, const char *note)
{
	struct pm_picture *q = &p->picture;
	double l = p->letter, width;
	axis_x(p), axis_y(p);
	border(p, p->x0, p->y0, p->x1, p->y1);
	width = pm_picture_text(NULL, 0, 0, l, false, xlabel, ink);
	pm_picture_text(q, (p->x0 + p->x1 - width) / 2, p->y1 + 4.1 * l, l, false, xlabel, ink);
	double free = (p->x0 + p->x1 + width) / 2 + 1.5 * l;
	width = pm_picture_text(NULL, 0, 0, l, true, ylabel, ink);
	pm_picture_text(q, 1.6 * l, (p->y0 + p->y1 + width) / 2, l, true, ylabel, ink);
	pm_picture_text(q, p->x0, p->y0 - 1.1 * l, 1.15 * l, false, title, ink);
	width = pm_picture_text(NULL, 0, 0, 0.8 * l, false, note, faint);
	pm_picture_text(q, fmax(p->x1 - width, free), p->y1 + 4.1 * l, 0.8 * l, false, note, faint);
}

static void bar_tick(struct pm_plot *p, double t, const char *text)
{
	double l = p->letter, y = p->y1 - t * (p->y1 - p->y0);
	int x = (int)(p->x1 + 2.2 * l);
	if (t < -1e-6 || t > 1 + 1e-6)
		return;
	pm_picture_fill(&p->picture, x, (int)y, x + (int)(0.5 * l), (int)y + pen(p), ink);
	pm_picture_text(&p->picture, x + 0.8 * l, y + l / 2, l, false, text, ink);
}

/* Between the powers of ten, 2 to 9 times the one below. */
static void bar_between(struct pm_plot *p, double low, double high)
{
	int x = (int)(p->x1 + 2.2 * p->letter);
	for (int decade = (int)floor(low); decade <= high && high - low < 8; decade++)
		for (int k = 2; k < 10; k++) {
			double t = (decade + log10(k) - low) / (high - low);
			int y = (int)(p->y1 - t * (p->y1 - p->y0));
			if (t > 0 && t < 1)
				pm_picture_fill(&p->picture, x, y, x + (int)(0.3 * p->letter), y + pen(p), ink);
		}
}

static void bar_ticks(struct pm_plot *p, const struct pm_scale *s)
{
	double at[most_ticks], step, low = s->log ? log10(s->lo) : s->lo, high = s->log ? log10(s->hi) : s->hi;
	bool decades = s->log && high - low >= 1.5;
	char text[40];
	if (decades)
		bar_between(p, low, high);
	for (int i = 0, n = pm_plot_ticks(decades || !s->log ? low : s->lo, decades || !s->log ? high : s->hi, 7, at, &step); i < n; i++) {
		if (decades && at[i] != floor(at[i]))
			continue;
		if (decades)
			snprintf(text, sizeof text, "10^{%d}", (int)at[i]);
		else
			label(at[i], step, text);
		bar_tick(p, decades ? (at[i] - low) / (high - low) : pm_scale_at(s, at[i]), text);
	}
}

/* A triangle at an end of the bar: some numbers lie beyond the scale. */
static void bar_point(struct pm_plot *p, int y, int direction, const unsigned char rgb[3])
{
	double x0 = p->x1 + p->letter, x1 = p->x1 + 2.2 * p->letter;
	for (int k = 0; k < (int)(0.8 * p->letter); k++) {
		double in = k / (0.8 * p->letter) * (x1 - x0) / 2;
		pm_picture_line(&p->picture, x0 + in, y + direction * (k + 0.5), x1 - in, y + direction * (k + 0.5), 1, rgb);
	}
}

void pm_plot_bar(struct pm_plot *p, const struct pm_scale *s)
{
	double l = p->letter;
	int x0 = (int)(p->x1 + l), x1 = (int)(p->x1 + 2.2 * l);
	unsigned char rgb[3];
	for (int y = p->y0; y < p->y1; y++) {
		shade(s, (p->y1 - y - 0.5) / (p->y1 - p->y0), rgb);
		pm_picture_fill(&p->picture, x0, y, x1, y + 1, rgb);
	}
	border(p, x0, p->y0, x1, p->y1);
	shade(s, 0, rgb);
	if (s->below)
		bar_point(p, p->y1, 1, rgb);
	shade(s, 1, rgb);
	if (s->above)
		bar_point(p, p->y0, -1, rgb);
	bar_ticks(p, s);
	double width = pm_picture_text(NULL, 0, 0, l, true, s->label, ink);
	pm_picture_text(&p->picture, p->picture.width - l, (p->y0 + p->y1 + width) / 2, l, true, s->label, ink);
}
