/* Growth rate gamma and frequency omega of a mode, a(t) ~ exp(gamma t) cos(omega t + phase). For a standing wave that oscillates: straight lines are fitted
 * to the logarithms and to the times of the peaks of |a| (the largest value of each half wave, by a parabola through 3 points), omega = pi over their distance.
 * Otherwise a straight line is fitted to log |a|, and omega comes from the phase if the wave travels, else it is 0.
 * Source: Birdsall and Langdon 1985, section 5-15 (the quantity plotted there). Cost: a few passes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "measure/growth.h"

void pm_mode(const struct pm_grid *g, const double *values, int m, double amplitude[2])
{
	const size_t n = g->points[0], rows = g->points[1] * g->points[2];
	struct pm_sum re = {0}, im = {0};
	for (size_t j = 0; j < n; j++) {
		const double angle = 2 * pm_pi * (double)(((uint64_t)j * (uint64_t)m) % n) / (double)n;
		struct pm_sum row = {0};
		for (size_t r = 0; r < rows; r++)
			pm_sum_add(&row, pm_grid_weight(g, j, r % g->points[1], r / g->points[1]) * values[r * n + j]);
		pm_sum_add(&re, pm_sum_total(row) * cos(angle));
		pm_sum_add(&im, -pm_sum_total(row) * sin(angle));
	}
	double weight = 0;
	for (size_t r = 0; r < rows; r++)
		weight += pm_grid_weight(g, 0, r % g->points[1], r / g->points[1]);
	amplitude[0] = 2 * pm_sum_total(re) / ((double)n * weight);
	amplitude[1] = 2 * pm_sum_total(im) / ((double)n * weight);
}

int pm_series_add(struct pm_series *s, double t, const double amplitude[2])
{
	if (s->n == s->room) {
		const size_t room = s->room ? 2 * s->room : 256;
		double **const array[] = {&s->t, &s->re, &s->im};
		for (int i = 0; i < 3; i++) {
			double *more = realloc(*array[i], room * sizeof *more);
			if (!more)
				return pm_fail(PM_DATA, "out of memory");
			*array[i] = more;
		}
		s->room = room;
	}
	s->t[s->n] = t, s->re[s->n] = amplitude[0], s->im[s->n] = amplitude[1];
	s->n++;
	return 0;
}

void pm_series_release(struct pm_series *s)
{
	free(s->t), free(s->re), free(s->im);
	*s = (struct pm_series){0};
}

static double size(const struct pm_series *s, size_t i) { return hypot(s->re[i], s->im[i]); }

/* The projection of point i on the direction (c, d) of the complex plane. */
static double along(const struct pm_series *s, size_t i, const double axis[2]) { return s->re[i] * axis[0] + s->im[i] * axis[1]; }

/* The direction in which a standing wave oscillates, and the fraction of the amplitude across it. */
static double axis_of(const struct pm_series *s, size_t a, size_t b, double axis[2])
{
	double re = 0, im = 0, all = 0, across = 0;
	for (size_t i = a; i < b; i++) { /* every point has the same weight, or the largest would dominate the direction */
		const double square = s->re[i] * s->re[i] + s->im[i] * s->im[i];
		re += square > 0 ? (s->re[i] * s->re[i] - s->im[i] * s->im[i]) / sqrt(square) : 0;
		im += square > 0 ? 2 * s->re[i] * s->im[i] / sqrt(square) : 0;
	}
	const double angle = 0.5 * atan2(im, re);
	axis[0] = cos(angle), axis[1] = sin(angle);
	for (size_t i = a; i < b; i++) {
		all += size(s, i);
		across += fabs(s->im[i] * axis[0] - s->re[i] * axis[1]);
	}
	return all > 0 ? across / all : 0;
}

/* Slope of the straight line through (x, y). */
struct line {
	double n, x, y, xx, xy;
};

static void line_add(struct line *l, double x, double y) { l->n++, l->x += x, l->y += y, l->xx += x * x, l->xy += x * y; }

static double line_slope(const struct line *l)
{
	const double below = l->n * l->xx - l->x * l->x;
	return l->n >= 2 && below > 0 ? (l->n * l->xy - l->x * l->y) / below : NAN;
}

/* The largest of |a| along the axis in the half wave that begins at point i; *end is where the next one begins. */
static size_t largest(const struct pm_series *s, size_t i, size_t b, const double axis[2], size_t *end)
{
	size_t top = i;
	const bool below = along(s, i, axis) < 0;
	for (; i < b && (along(s, i, axis) < 0) == below; i++)
		top = fabs(along(s, i, axis)) > fabs(along(s, top, axis)) ? i : top;
	*end = i;
	return top;
}

/* From the peaks of |a| along the axis, one for each half wave (there may be more by noise); false if there are fewer than three. */
static bool from_peaks(const struct pm_series *s, size_t a, size_t b, const double axis[2], struct pm_growth *g)
{
	struct line height = {0}, time = {0};
	for (size_t start = a, end; start < b; start = end) {
		const size_t i = largest(s, start, b, axis, &end);
		if (i == a || i + 1 >= b)
			continue;
		const double sign = along(s, i, axis) < 0 ? -1 : 1;
		const double l = sign * along(s, i - 1, axis), m = sign * along(s, i, axis), r = sign * along(s, i + 1, axis), bend = l - 2 * m + r;
		if (!(m > l && m >= r && bend < 0))
			continue;
		const double shift = 0.5 * (l - r) / bend, t = s->t[i] + shift * 0.5 * (s->t[i + 1] - s->t[i - 1]);
		line_add(&height, t - s->t[a], log(m - 0.25 * (l - r) * shift));
		line_add(&time, time.n, t - s->t[a]);
	}
	if (time.n < 3)
		return false;
	g->gamma = line_slope(&height);
	g->omega = pm_pi / line_slope(&time);
	return true;
}

static void from_size(const struct pm_series *s, size_t a, size_t b, bool travels, struct pm_growth *g)
{
	struct line height = {0}, phase = {0};
	double turned = 0, before = 0;
	for (size_t i = a; i < b; i++) {
		const double now = atan2(s->im[i], s->re[i]);
		if (!(size(s, i) > 0))
			continue;
		turned += phase.n ? remainder(now - before, 2 * pm_pi) : 0;
		before = now;
		line_add(&height, s->t[i] - s->t[a], log(size(s, i)));
		line_add(&phase, s->t[i] - s->t[a], turned);
	}
	g->gamma = line_slope(&height);
	g->omega = travels ? fabs(line_slope(&phase)) : 0;
}

/* Where |a| climbs from 1 % to 10 % of its first top (the first local one above half of the largest), if it does so without oscillating; else all points. */
static void choose(const struct pm_series *s, size_t *a, size_t *b)
{
	size_t most = 0, top = 0, from, to, falls = 0;
	for (size_t i = 0; i < s->n; i++)
		most = size(s, i) > size(s, most) ? i : most;
	while (size(s, top) < 0.5 * size(s, most))
		top++;
	while (top < most && size(s, top + 1) > size(s, top))
		top++;
	for (from = top; from > 0 && size(s, from - 1) > 0.01 * size(s, top);)
		from--;
	for (to = from; to < top && size(s, to) <= 0.1 * size(s, top); to++)
		falls += size(s, to + 1) < size(s, to);
	if (from > 0 && to >= from + 3 && falls <= (to - from) / 8)
		*a = from, *b = to;
}

struct pm_growth pm_growth_of(const struct pm_series *s, double from, double to)
{
	struct pm_growth g = {NAN, NAN, NAN, NAN, 0};
	double axis[2];
	size_t a = 0, b = s->n;
	if (isnan(from) && s->n)
		choose(s, &a, &b);
	while (a < b && s->t[a] < from)
		a++;
	while (b > a && s->t[b - 1] > to)
		b--;
	g.points = b - a;
	if (b - a < 2)
		return g;
	g.from = s->t[a], g.to = s->t[b - 1];
	const bool travels = axis_of(s, a, b, axis) > 0.2;
	if (travels || !from_peaks(s, a, b, axis, &g))
		from_size(s, a, b, travels, &g);
	return g;
}
