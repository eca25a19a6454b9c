/* Interpolates between the rows of the atlas: log error is linear in log h and log dt between two rows. Rows may be in any order; an error of NaN is a
 * failed run. Assumes that the error falls with h and dt once it is below 1. Source: docs/accuracy/README.md. Cost: rows.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "planner/atlas.h"

struct row {
	double x, error;
};

enum { MOST = 32 };

static void insert(struct row *r, int *n, double x, double error)
{
	int i = *n;
	if (!(error >= 0) || *n == MOST)
		return;
	for (; i && r[i - 1].x > x; i--)
		r[i] = r[i - 1];
	r[i] = (struct row){x, fmax(error, 1e-300)};
	(*n)++;
}

static double slope(const struct row *a, const struct row *b) { return log(b->error / a->error) / log(b->x / a->x); }

double pm_atlas_force_error(const char *scene, const char *solver, const char *kernel, const char *gradient, double h)
{
	struct row r[MOST];
	int n = 0, i = 1;
	for (const struct pm_atlas_force *f = pm_atlas_forces; f->scene; f++)
		if (!strcmp(f->scene, scene) && !strcmp(f->solver, solver) && !strcmp(f->kernel, kernel) && !strcmp(f->gradient, gradient))
			insert(r, &n, f->h, f->error);
	if (n < 2)
		return NAN;
	while (i < n - 1 && r[i].x < h)
		i++;
	const double p = fmax(0, slope(&r[i - 1], &r[i]));
	return r[i - 1].error * pow(h / r[i - 1].x, h < r[0].x ? fmin(p, 2) : p); /* below the measured range an error falls at most as h^2 */
}

double pm_atlas_longest(const char *problem, const char *scheme, double error)
{
	struct row r[MOST];
	int n = 0, i = 0;
	for (const struct pm_atlas_step *s = pm_atlas_steps; s->problem; s++)
		if (!strcmp(s->problem, problem) && !strcmp(s->scheme, scheme))
			insert(r, &n, s->dt, s->error);
	if (n < 2)
		return NAN;
	while (i < n && r[i].error <= error) /* starts with the shortest step, because a long step may have a small error by chance */
		i++;
	if (i == n)
		return r[n - 1].x;
	const int a = i ? i - 1 : 0;
	return r[a].x * pow(error / r[a].error, 1 / fmax(0.5, slope(&r[a], &r[a + 1])));
}

double pm_atlas_time(const char *problem)
{
	for (const struct pm_atlas_step *s = pm_atlas_steps; s->problem; s++)
		if (!strcmp(s->problem, problem) && (!strcmp(s->scheme, "rk4") || !strcmp(s->scheme, "boris")))
			return s->dt * (s->evaluations - !strcmp(s->scheme, "boris")) / (strcmp(s->scheme, "boris") ? 4 : 1);
	return NAN;
}
