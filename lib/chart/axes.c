/* The axes of a chart: their ends, where a number is on them, and the ticks: 1, 2 or 5 times a power of ten, or the powers of ten themselves.
 * A number 0 on a logarithmic axis stands below a break at the low end. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "chart/chart.h"

static const double zero_strip = 0.07; /* of the axis, below the break */

double pm_chart_break(const struct pm_chart_axis *a) { return a->log && a->zero ? zero_strip : 0; }

double pm_chart_at(const struct pm_chart_axis *a, double value)
{
	double low = pm_chart_break(a);
	if (!a->log)
		return a->down ? (a->hi - value) / (a->hi - a->lo) : (value - a->lo) / (a->hi - a->lo);
	if (value > 0)
		return low + (1 - low) * log(value / a->lo) / log(a->hi / a->lo);
	return value == 0 && a->zero ? 0.4 * low : NAN;
}

double pm_chart_value(const struct pm_chart_axis *a, double t)
{
	double low = pm_chart_break(a), u = (t - low) / (1 - low);
	return a->log ? a->lo * pow(a->hi / a->lo, u) : a->lo + u * (a->hi - a->lo);
}

/* ---- the ends ---- */

static void widen(struct pm_chart_axis *a, double v, double *lo, double *hi)
{
	if (!isfinite(v))
		return;
	if (a->log && v <= 0) {
		a->zero |= v == 0;
		return;
	}
	*lo = fmin(*lo, v), *hi = fmax(*hi, v);
}

/* The ends, where they were not given: those of the data with a margin. */
static int settle(struct pm_chart_axis *a, double lo, double hi, const char *which)
{
	bool low = isnan(a->lo), high = isnan(a->hi);
	if (lo > hi && a->log && a->zero)
		lo = hi = 1;
	if (lo > hi && (low || high))
		return pm_fail(PM_DATA, "nothing to draw: no finite number%s for the %s axis", a->log ? " above 0" : "", which);
	double pad = a->log ? pow(hi / lo, 0.04) : 0.04 * (hi - lo);
	if (a->names)
		lo = 1, hi = (double)a->names, pad = 0.6;
	else if (a->log && hi / lo < 1 + 1e-9)
		pad = 2;
	else if (!a->log && !(hi - lo > 1e-13 * fmax(fabs(lo), fabs(hi))))
		pad = lo != 0 || hi != 0 ? 0.1 * fmax(fabs(lo), fabs(hi)) : 1;
	if (low)
		a->lo = a->log ? lo / pad : lo - pad;
	if (high)
		a->hi = a->log ? hi * pad : hi + pad;
	if (!(a->hi > a->lo) || !isfinite(a->hi - a->lo) || (a->log && !(a->lo > 0)))
		return pm_fail(PM_DATA, "the %s axis cannot reach from %g to %g%s", which, a->lo, a->hi, a->log ? " in the logarithm" : "");
	return 0;
}

int pm_chart_scale(struct pm_chart *c)
{
	double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
	const bool fixed = !isnan(c->x.lo) || !isnan(c->x.hi);
	c->x.beyond = c->y.beyond = 0;
	for (size_t k = 0; k < c->nseries; k++) {
		const struct pm_chart_series *s = &c->series[k];
		for (size_t i = 0; i < s->n; i++) {
			if (isnan(s->x[i]) || isnan(s->y[i]))
				continue;
			c->x.beyond += c->x.log && s->x[i] < 0, c->y.beyond += c->y.log && s->y[i] < 0;
			if (s->colour < 0 || (c->x.log && s->x[i] < 0) || (c->y.log && s->y[i] < 0))
				continue; /* guides follow the data */
			widen(&c->x, s->x[i], &lo[0], &hi[0]);
			if (fixed && (s->x[i] < c->x.lo || s->x[i] > c->x.hi))
				continue;
			widen(&c->y, s->y[i], &lo[1], &hi[1]);
			for (int side = -1; side <= 1; side += 2) {
				double x = s->x[i] + side * (s->dx && !isnan(s->dx[i]) ? s->dx[i] : 0);
				double y = s->y[i] + side * (s->dy && !isnan(s->dy[i]) ? s->dy[i] : 0);
				if (!c->x.log || x > 0)
					widen(&c->x, x, &lo[0], &hi[0]);
				if (!c->y.log || y > 0)
					widen(&c->y, y, &lo[1], &hi[1]);
			}
		}
	}
	for (int d = 0; d < 2; d++)
		for (size_t i = 0; i < c->nlevels[d]; i++)
			widen(d ? &c->y : &c->x, c->level[d][i].at, &lo[d], &hi[d]);
	int status = settle(&c->x, lo[0], hi[0], "x");
	return status ? status : settle(&c->y, lo[1], hi[1], "y");
}

/* ---- ticks ---- */

static void tick(struct pm_chart_ticks *t, double at, const char *text)
{
	if (t->n == PM_CHART_TICKS)
		return;
	t->at[t->n] = at == 0 ? 0 : at;
	snprintf(t->text[t->n++], sizeof t->text[0], "%s", text);
}

static void minor(struct pm_chart_ticks *t, double at)
{
	if (t->nminor < 9 * PM_CHART_TICKS)
		t->minor[t->nminor++] = at;
}

static double step_of(double range, int most, int *parts)
{
	double raw = range / most, power = pow(10, floor(log10(raw))), left = raw / power;
	*parts = left <= 1 ? 5 : left <= 2 ? 4 : 5;
	return power * (left <= 1 ? 1 : left <= 2 ? 2 : left <= 5 ? 5 : 10);
}

/* plain: as 0.01, where all of the axis can be written so. */
static void power_text(int power, bool plain, char *out, size_t room)
{
	if (plain || power == 0 || power == 1)
		snprintf(out, room, "%.*f", power < 0 ? -power : 0, pow(10, power));
	else
		snprintf(out, room, "10^{%d}", power);
}

/* What is common to all labels: a power of ten where the numbers are large or small, and an offset where they differ in late digits only. */
static void common(const struct pm_chart_axis *a, struct pm_chart_ticks *t, double *offset, int *power)
{
	double most = fmax(fabs(a->lo), fabs(a->hi)), range = a->hi - a->lo;
	*offset = 0, *power = 0;
	if (range < 1e-4 * most) {
		double grain = pow(10, ceil(log10(range)) + 1);
		*offset = grain * round(0.5 * (a->lo + a->hi) / grain);
		most = fmax(fabs(a->lo - *offset), fabs(a->hi - *offset));
	}
	int digits = (int)floor(log10(most) + 1e-9);
	if (digits >= 5 || digits <= -4)
		*power = digits;
	char shift[40] = "";
	if (*offset != 0)
		snprintf(shift, sizeof shift, " %c %.15g", *offset < 0 ? '-' : '+', fabs(*offset));
	if (*power)
		snprintf(t->factor, sizeof t->factor, "x 10^{%d}%s", *power, shift);
	else
		snprintf(t->factor, sizeof t->factor, "%s", shift + (*shift != 0));
}

static void linear(const struct pm_chart_axis *a, int most, struct pm_chart_ticks *t)
{
	int parts, power;
	double offset, step = step_of(a->hi - a->lo, most, &parts);
	common(a, t, &offset, &power);
	int decimals = (int)fmax(0, -floor(log10(step) + 1e-9) + power);
	for (double k = ceil((a->lo - offset) / step - 1e-9); k * step + offset <= a->hi + 1e-9 * step; k++) {
		char text[48];
		double v = k == 0 ? 0 : k * step / pow(10, power);
		snprintf(text, sizeof text, "%.*f", decimals, v);
		tick(t, offset + k * step, text);
	}
	for (double k = ceil((a->lo - offset) / (step / parts) - 1e-9); k * step / parts + offset <= a->hi + 1e-9 * step; k++)
		if (fabs(k / parts - round(k / parts)) > 1e-6)
			minor(t, offset + k * step / parts);
}

/* Less than a decade and a half: 1, 2, 5, or round numbers. */
static void few_decades(const struct pm_chart_axis *a, int most, struct pm_chart_ticks *t)
{
	const int zeros = t->n, first = (int)floor(log10(a->lo)), last = (int)floor(log10(a->hi) + 1e-9);
	for (int decade = first; decade <= last; decade++)
		for (int k = 1; k < 10; k++) {
			double v = k * pow(10, decade);
			char text[48];
			if (v < a->lo * (1 - 1e-9) || v > a->hi * (1 + 1e-9))
				continue;
			if (decade < -4 || decade > 4)
				snprintf(text, sizeof text, "%d 10^{%d}", k, decade);
			else
				snprintf(text, sizeof text, "%g", v);
			if (k == 1 || k == 2 || k == 5)
				tick(t, v, text);
			else
				minor(t, v);
		}
	if ((t->n < zeros + 3 && a->hi / a->lo < 10) || t->n > zeros + most) {
		struct pm_chart_axis plain = *a;
		plain.log = false, t->n = zeros, t->nminor = 0;
		linear(&plain, most, t);
	}
}

static void decades(const struct pm_chart_axis *a, int most, struct pm_chart_ticks *t)
{
	int first = (int)ceil(log10(a->lo) - 1e-9), last = (int)floor(log10(a->hi) + 1e-9), every = 1;
	char text[48];
	while ((last - first) / every + 1 > most)
		every++;
	for (int k = first; k <= last; k++)
		if ((k % every + every) % every == 0) {
			power_text(k, first >= -3 && last <= 4, text, sizeof text);
			tick(t, pow(10, k), text);
		} else
			minor(t, pow(10, k));
	for (int k = first - 1; every == 1 && last - first <= 12 && k <= last; k++)
		for (int m = 2; m < 10; m++)
			if (m * pow(10, k) >= a->lo && m * pow(10, k) <= a->hi)
				minor(t, m * pow(10, k));
}

void pm_chart_ticks(const struct pm_chart_axis *a, int most, struct pm_chart_ticks *t)
{
	t->n = t->nminor = 0, *t->factor = 0;
	most = most < 2 ? 2 : most > PM_CHART_TICKS - 2 ? PM_CHART_TICKS - 2 : most;
	if (a->names) {
		for (size_t i = 0; i < a->names; i++)
			if (a->names <= (size_t)most || i % (a->names / (size_t)most + 1) == 0)
				tick(t, (double)i + 1, a->name[i]);
		return;
	}
	if (a->log && a->zero)
		tick(t, 0, "0");
	if (!a->log)
		linear(a, most, t);
	else if (a->hi / a->lo < 32)
		few_decades(a, most, t);
	else
		decades(a, most, t);
}
