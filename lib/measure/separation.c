/* Separation of two runs: sqrt(1/n sum |x_a - x_b|^2), as it grows with the largest Lyapunov exponent, exp(lambda t), until it is as large as the
 * system (Benettin, Galgani and Strelcyn 1976). The rate along a path varies, so the error of the slope of ln d is that of the mean of the slopes of
 * eight parts of the window, each fitted alone. Cost N. SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/separation.h"
#include "stream/declare.h"
#include "stream/over-stretches.h"
#include "world/world.h"

int pm_separation_reads(struct pm_frame *f, const char *const sets[2])
{
	const struct pm_set *s[2];
	for (int k = 0; k < 2; k++) {
		if (!(s[k] = pm_frame_set(f, sets[k])))
			return pm_fail(PM_DATA, "--separation: no set '%s' (stack puts a run and its shadow into one frame)", sets[k]);
		if (!pm_frame_field(f, sets[k], "x"))
			return pm_fail(PM_DATA, "--separation: '%s' has no positions 'x'", sets[k]);
		pm_reads(f, sets[k], "x");
		if (pm_frame_field(f, sets[k], "v"))
			pm_reads(f, sets[k], "v");
		if (pm_frame_field(f, sets[k], "id"))
			pm_reads(f, sets[k], "id");
	}
	return s[0]->n == s[1]->n ? 0 : pm_fail(PM_DATA, "--separation: '%s' has %llu particles, '%s' %llu", sets[0], (unsigned long long)s[0]->n, sets[1],
		(unsigned long long)s[1]->n);
}

/* stack adds a constant to the ids of the second stream. */
static int same_order(const struct pm_frame *f, const char *const sets[2])
{
	const struct pm_field *a = pm_frame_field(f, sets[0], "id"), *b = pm_frame_field(f, sets[1], "id");
	if (!a || !b || a->type != PM_I64 || b->type != PM_I64)
		return 0;
	const int64_t *i = pm_in_i64(a, 0), *j = pm_in_i64(b, 0);
	int64_t apart = a->count && !a->first ? i[0] - j[0] : INT64_MIN; /* of the first particle of all, which one rank has */
	int status = pm_world_count(0, PM_MOST_OF, 1, &apart);
	for (size_t p = 0; p < a->count && !status; p++)
		if (i[p] - j[p] != apart)
			status = pm_fail(PM_DATA, "--separation: the particles of '%s' and '%s' are not in the same order (stack them before ssort)", sets[0],
				sets[1]);
	return pm_world_agree(status);
}

struct pairs {
	const double *x, *y;
	double period; /* 0: none */
};

static void make(const void *data, size_t from, size_t to, void *part)
{
	const struct pairs *p = data;
	for (size_t i = from; i < to; i++) {
		double d = p->x[i] - p->y[i];
		d -= p->period > 0 ? p->period * floor(d / p->period + 0.5) : 0;
		pm_sum_add(part, d * d);
	}
}

static double apart_in(const struct pm_frame *f, const char *const sets[2], const char *name)
{
	const struct pm_field *a = pm_frame_field(f, sets[0], name), *b = pm_frame_field(f, sets[1], name);
	const bool positions = name[0] == 'x';
	struct pm_sum sum = {0, 0};
	const struct pm_parts parts = {.size = sizeof sum, .make = make, .join = pm_join_sums};
	const double n = (double)pm_frame_set(f, sets[0])->n;
	if (!a || !b || !(n > 0))
		return NAN;
	for (int c = 0; c < a->components && c < b->components; c++) {
		const double period = positions && c < f->dim && f->pface[c][0] == PM_PFOLD ? f->hi[c] - f->lo[c] : 0;
		pm_over_stretches(a, &parts, &(struct pairs){pm_in(a, c), pm_in(b, c), period}, &sum);
	}
	return sqrt(pm_sum_total(sum) / n);
}

int pm_separation_of(const struct pm_frame *f, const char *const sets[2], double apart[2])
{
	apart[0] = apart_in(f, sets, "x");
	apart[1] = apart_in(f, sets, "v");
	return same_order(f, sets);
}

enum { PARTS = 8 };

static double slope(size_t n, const double *t, const double *d)
{
	double mt = 0, my = 0, tt = 0, ty = 0;
	for (size_t i = 0; i < n; i++)
		mt += t[i] / (double)n, my += log(d[i]) / (double)n;
	for (size_t i = 0; i < n; i++)
		tt += (t[i] - mt) * (t[i] - mt), ty += (t[i] - mt) * (log(d[i]) - my);
	return ty / tt;
}

struct pm_divergence pm_divergence_of(size_t n, const double *t, const double *d, double from, double to)
{
	struct pm_divergence e = {.lambda = NAN, .error = NAN, .from = NAN, .to = NAN};
	size_t a = 0, b = 0;
	double most = 0, mean = 0, square = 0;
	for (size_t i = 0; i < n; i++)
		most = fmax(most, d[i]);
	while (a < n && !(d[a] > 0 && !(t[a] < from)))
		a++;
	for (b = a; b < n && d[b] > 0 && !(t[b] > to) && (!isnan(to) || d[b] <= 0.01 * most); b++)
		;
	e.points = b - a;
	if (e.points < 3 * PARTS)
		return e;
	for (int k = 0; k < PARTS; k++) {
		const size_t i = a + e.points * (size_t)k / PARTS, j = a + e.points * (size_t)(k + 1) / PARTS;
		const double part = slope(j - i, t + i, d + i);
		mean += part / PARTS, square += part * part / PARTS;
	}
	e.lambda = slope(e.points, t + a, d + a);
	e.error = sqrt(fmax(0, square - mean * mean) / (PARTS - 1));
	e.from = t[a], e.to = t[b - 1];
	return e;
}
