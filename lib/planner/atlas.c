/* Interpolates between the rows of the atlas: log error is linear in log h and log dt between two rows. Rows may be in any order; an error of NaN is a
 * failed run. Assumes that the error falls with h and dt once it is below 1. Source: docs/accuracy/README.md. Cost: rows.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "planner/atlas.h"

struct row {
	double x, error, work; /* work: evaluations times x, the same in every row but for starting, rounding, and the iterations of ias15 */
};

enum { MOST = 32 };

static void insert(struct row *r, int *n, double x, double error, double work)
{
	int i = *n;
	if (!(error >= 0) || *n == MOST)
		return;
	for (; i && r[i - 1].x > x; i--)
		r[i] = r[i - 1];
	r[i] = (struct row){x, fmax(error, 1e-300), work};
	(*n)++;
}

static double slope(const struct row *a, const struct row *b) { return log(b->error / a->error) / log(b->x / a->x); }

double pm_atlas_force_error(const char *scene, const char *solver, const char *kernel, const char *gradient, double h)
{
	struct row r[MOST];
	int n = 0, i = 1;
	for (const struct pm_atlas_force *f = pm_atlas_forces; f->scene; f++)
		if (!strcmp(f->scene, scene) && !strcmp(f->solver, solver) && !strcmp(f->kernel, kernel) && !strcmp(f->gradient, gradient))
			insert(r, &n, f->h, f->error, 0);
	if (n < 2)
		return NAN;
	while (i < n - 1 && r[i].x < h)
		i++;
	const double p = fmax(0, slope(&r[i - 1], &r[i]));
	return r[i - 1].error * pow(h / r[i - 1].x, h < r[0].x ? fmin(p, 2) : p); /* below the measured range an error falls at most as h^2 */
}

struct pm_atlas_found pm_atlas_find(const char *problem, const char *scheme, double error)
{
	struct row r[MOST];
	int n = 0, i = 0;
	for (const struct pm_atlas_step *s = pm_atlas_steps; s->problem; s++)
		if (!strcmp(s->problem, problem) && !strcmp(s->scheme, scheme))
			insert(r, &n, s->dt, s->error, s->evaluations * s->dt);
	if (n < 2)
		return (struct pm_atlas_found){.dt = NAN, .evaluations = NAN};
	while (i < n && r[i].error <= error) /* starts with the shortest step, because a long step may have a small error by chance */
		i++;
	const int a = i ? i - 1 : 0;
	const double dt = i == n ? r[n - 1].x : r[a].x * pow(error / r[a].error, 1 / fmax(0.5, slope(&r[a], &r[a + 1])));
	return (struct pm_atlas_found){.dt = dt, .evaluations = r[a].work / dt, .outside = i == 0};
}

double pm_atlas_longest(const char *problem, const char *scheme, double error) { return pm_atlas_find(problem, scheme, error).dt; }

static double speed2(double e) { return (1 + e) / pow(1 - e, 3); }

struct pm_atlas_found pm_atlas_orbit(double e, const char *scheme, double error)
{
	static const struct {
		double e;
		const char *problem;
	} at[] = {{0, "kepler-circle"}, {0.5, "kepler-0.5"}, {0.7, "kepler-0.7"}, {0.9, "kepler"}, {0.99, "kepler-0.99"}, {0.999, "kepler-0.999"}};
	enum { LAST = sizeof at / sizeof *at - 2 };
	int i = 0;
	while (i < LAST && e > at[i + 1].e)
		i++;
	const struct pm_atlas_found a = pm_atlas_find(at[i].problem, scheme, error), b = pm_atlas_find(at[i + 1].problem, scheme, error);
	const double w = log(speed2(e) / speed2(at[i].e)) / log(speed2(at[i + 1].e) / speed2(at[i].e));
	return (struct pm_atlas_found){.dt = a.dt * pow(b.dt / a.dt, w), .evaluations = a.evaluations * pow(b.evaluations / a.evaluations, w),
		.outside = a.outside || b.outside || !(e <= at[LAST + 1].e * (1 + 1e-12))};
}

double pm_atlas_time(const char *problem)
{
	for (const struct pm_atlas_step *s = pm_atlas_steps; s->problem; s++)
		if (!strcmp(s->problem, problem) && (!strcmp(s->scheme, "rk4") || !strcmp(s->scheme, "boris")))
			return s->dt * (s->evaluations - !strcmp(s->scheme, "boris")) / (strcmp(s->scheme, "boris") ? 4 : 1);
	return NAN;
}
