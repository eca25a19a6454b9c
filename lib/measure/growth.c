/* Growth rate gamma and frequency omega of a series. Windows between 24 marks are fitted by one exponential each (exponential-fit.c); marks divide the whole
 * series, its part up to the first large maximum, its first quarter and its first sixteenth. A window counts if it is an exponential: the residual is
 * below 15 % of the envelope, and it has 8 points; and if it is more than chance: either the amplitude changes by e^1.5 (e^2 if it does not oscillate)
 * or more, is at one end 5 times the noise, and does not sink back there, or the window is half of the series. The noise is the larger of the residual
 * at the weak end and what the series is beyond that end, where the wave has decayed or before it has grown. Of these windows the one with the smallest
 * standard error of gamma over |gamma + i omega| is taken, and its ends are moved while that falls. There is no other way to a number: without such a
 * window there is none, and a reason.
 * Source: Birdsall and Langdon 1985, section 5-15 (the quantity plotted there); docs/methods/diag.md. Cost: about 10^4 passes over the points.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "measure/exponential-fit.h"

enum { MARKS = 24, LEAST = 8 };
static const double most_residual = 0.15, least_over_noise = 5;

struct window {
	size_t a, b; /* points a..b-1 */
	struct pm_exponential e;
	double over_noise, score; /* the smaller the better */
	enum { EXPONENTIAL, NOISE, SHORT, BENT, NO_FIT } fault;
};

struct record { /* sums over the points before each, n + 1 of them: of ln |a|, t ln |a|, t, t^2 */
	const struct pm_series *s;
	double *sum[4];
};

static double size(const struct pm_series *s, size_t i) { return hypot(s->re[i], s->im[i]); }

/* The largest of a point and its neighbours, so that a zero of a standing wave is no large logarithm. */
static double height(const struct pm_series *s, size_t i)
{
	return fmax(size(s, i), fmax(i ? size(s, i - 1) : 0, i + 1 < s->n ? size(s, i + 1) : 0));
}

static void record_fill(struct record *r)
{
	const struct pm_series *s = r->s;
	for (size_t i = 0; i < s->n; i++) {
		const double t = s->t[i] - s->t[0], l = log(fmax(height(s, i), 1e-300)), term[4] = {l, t * l, t, t * t};
		for (int k = 0; k < 4; k++)
			r->sum[k][i + 1] = r->sum[k][i] + term[k];
	}
}

/* Slope of the straight line through ln |a| of points a..b-1. */
static double slope(const struct record *r, size_t a, size_t b)
{
	double x[4];
	for (int k = 0; k < 4; k++)
		x[k] = (r->sum[k][b] - r->sum[k][a]) / (double)(b - a);
	const double below = x[3] - x[2] * x[2];
	return below > 0 ? (x[1] - x[0] * x[2]) / below : 0;
}

/* The geometric mean of |a| over points a..b-1; 0 for fewer than 3, which say nothing. */
static double typical(const struct record *r, size_t a, size_t b) { return b >= a + 3 ? exp((r->sum[0][b] - r->sum[0][a]) / (double)(b - a)) : 0; }

/* Fewest points of a window: a short series is taken nearly as a whole. */
static size_t fewest(const struct pm_series *s) { return s->n >= 2 * LEAST ? LEAST : s->n > 4 ? s->n / 2 + 1 : 3; }

/* e-foldings that are more than chance: without oscillation there is less to recognise a wave by. */
static double least_foldings(const struct pm_exponential *e) { return e->omega > 0 ? 1.5 : 2; }

/* A wave that grows stays large, and one that is damped was as large before: else it is a chance of noise. Looked at where there is half of the window or
 * more on that side. */
static bool sinks_back(const struct record *r, const struct window *w)
{
	const size_t a = w->e.gamma < 0 ? 0 : w->b, b = w->e.gamma < 0 ? w->a : r->s->n;
	return 2 * (b - a) >= w->b - w->a && typical(r, a, b) < 0.7 * fmax(w->e.first, w->e.last);
}

/* Fits and judges; chosen: by this file, not by the user, who has looked at the series. */
static struct window window_of(const struct record *r, size_t a, size_t b, bool chosen)
{
	const struct pm_series *s = r->s;
	struct window w = {.a = a, .b = b, .fault = NO_FIT};
	if (b < a + fewest(s) || !pm_exponential_fit(s, a, b, slope(r, a, b), &w.e))
		return w;
	const double length = s->t[b - 1] - s->t[a], foldings = fabs(w.e.gamma) * length, whole = s->t[s->n - 1] - s->t[0];
	const bool changes = foldings >= least_foldings(&w.e);
	const double beyond = !changes ? 0 : w.e.gamma < 0 ? typical(r, b, s->n) : typical(r, 0, a);
	const double weak = fmin(w.e.first, w.e.last), strong = fmax(w.e.first, w.e.last), noise = fmax(w.e.residual * weak, beyond);
	w.over_noise = strong / fmax(noise, 1e-16 * strong);
	w.score = w.e.error / hypot(hypot(w.e.gamma, w.e.omega), 0.1 / length) + 1e-9 * (double)s->n / (double)(b - a);
	w.fault = !(w.e.residual <= most_residual) ? BENT : chosen && (changes ? sinks_back(r, &w) : length < 0.5 * whole) ? SHORT
		: w.over_noise < least_over_noise ? NOISE : EXPONENTIAL;
	return w;
}

/* Is v better than w? A window without fault, else the one nearest to it. */
static bool better(const struct window *v, const struct window *w)
{
	return v->fault != w->fault ? v->fault < w->fault : v->fault == BENT ? v->e.residual < w->e.residual : v->fault != NO_FIT && v->score < w->score;
}

static void search(const struct record *r, size_t n, struct window *best)
{
	const size_t marks = n < MARKS ? n : MARKS;
	for (size_t i = 0; i < marks; i++)
		for (size_t j = i + 1; j <= marks; j++) {
			const struct window w = window_of(r, i * n / marks, j * n / marks, true);
			*best = better(&w, best) ? w : *best;
		}
}

/* Moves the ends by a part of the window while that is better. */
static void refine(const struct record *r, struct window *best)
{
	for (size_t part = (best->b - best->a) / 6; part > 0; part /= 2)
		for (int k = 0; k < 4; k++) {
			size_t a = best->a, b = best->b;
			a = k == 0 ? (a > part ? a - part : 0) : k == 1 ? a + part : a;
			b = k == 2 ? b - part : k == 3 && b + part < r->s->n ? b + part : b;
			const struct window w = window_of(r, a, b, true);
			if (better(&w, best))
				*best = w;
		}
}

/* Points until the first maximum above half of the largest value. */
static size_t first_top(const struct pm_series *s)
{
	size_t most = 0, top = 0;
	for (size_t i = 0; i < s->n; i++)
		most = size(s, i) > size(s, most) ? i : most;
	while (size(s, top) < 0.5 * size(s, most))
		top++;
	while (top < most && size(s, top + 1) > size(s, top))
		top++;
	return top + 1;
}

static struct window choose(const struct record *r)
{
	const size_t n = r->s->n, part[] = {n, first_top(r->s), n / 4, n / 16};
	struct window best = {.fault = NO_FIT};
	for (int k = 0; k < 4; k++)
		if (part[k] >= 3 && (!k || part[k] >= LEAST))
			search(r, part[k], &best);
	if (best.fault == EXPONENTIAL)
		refine(r, &best);
	return best;
}

/* What is known before a fit: false with a reason. */
static bool fit_for_fit(const struct pm_series *s, size_t points, struct pm_growth *g)
{
	double most = 0;
	for (size_t i = 0; i < s->n; i++)
		most = fmax(most, size(s, i));
	if (points < 3)
		snprintf(g->reason, sizeof g->reason, "%zu points are too few (more frames: cycle --every)", points);
	else if (!(most > 0))
		snprintf(g->reason, sizeof g->reason, "the amplitude is 0");
	else if (most < 1e-13 * s->scale)
		snprintf(g->reason, sizeof g->reason, "its amplitude, %.2g at most, is the rounding of a field of %.2g", most, s->scale);
	return !g->reason[0];
}

static void explain(const struct pm_series *s, const struct window *w, bool given, struct pm_growth *g)
{
	const char *which = given ? "the window" : "the best window";
	char times[64];
	snprintf(times, sizeof times, "%g to %g", w->b ? s->t[w->a] : NAN, w->b ? s->t[w->b - 1] : NAN);
	if (w->fault == NOISE)
		snprintf(g->reason, sizeof g->reason, "it is noise, or several waves at once: in %s, t = %s, the amplitude is at most %.2g times the noise "
			"(%g are needed)", which, times, w->over_noise, least_over_noise);
	else if (w->fault == SHORT)
		snprintf(g->reason, sizeof g->reason, "it is noise, or several waves at once (dispersion shows them): it is like one exponential only for "
			"short times, as from t = %s", times);
	else if (w->fault == BENT)
		snprintf(g->reason, sizeof g->reason, "%s exponential: the fit to %s, t = %s, leaves %.0f %% of it",
			given ? "the window is no" : "no window is an", which, times, 100 * w->e.residual);
	else
		snprintf(g->reason, sizeof g->reason, "%s exponential: no fit converges", given ? "the window is no" : "no window is an");
}

static int record_make(struct record *r)
{
	for (int k = 0; k < 4; k++)
		if (!(r->sum[k] = pm_alloc(r->s->n + 1, sizeof *r->sum[k])))
			return -PM_DATA;
		else
			r->sum[k][0] = 0;
	record_fill(r);
	return 0;
}

int pm_growth_of(const struct pm_series *s, double from, double to, struct pm_growth *g)
{
	const bool given = !isnan(from);
	struct record r = {.s = s};
	struct window w = {.fault = NO_FIT};
	size_t a = 0, b = s->n;
	*g = (struct pm_growth){.gamma = NAN, .omega = NAN, .error = NAN, .from = NAN, .to = NAN, .over_noise = NAN};
	while (given && a < b && s->t[a] < from)
		a++;
	while (given && b > a && s->t[b - 1] > to)
		b--;
	g->points = b - a;
	int status = 0;
	if (fit_for_fit(s, b - a, g) && !(status = record_make(&r))) {
		w = given ? window_of(&r, a, b, false) : choose(&r);
		if (w.fault == EXPONENTIAL)
			*g = (struct pm_growth){.gamma = w.e.gamma, .omega = w.e.omega, .error = w.e.error, .from = s->t[w.a], .to = s->t[w.b - 1],
				.points = w.b - w.a, .over_noise = w.over_noise};
		else
			explain(s, &w, given, g);
	}
	for (int k = 0; k < 4; k++)
		pm_free(r.sum[k]);
	return status;
}
