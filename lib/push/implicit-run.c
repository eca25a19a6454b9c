/* Implicit steps: Y = base + part dt k(Y), solved by iteration, one pass of the sentence each. Where every rate is one of `field`, which depends on the
 * particle alone, by Newton's method with a Jacobian by differences (implicit-newton.c), which follows the root that goes over into the start as dt falls.
 * Otherwise, and where a particle has more than 10 values, by Anderson's iteration (implicit-anderson.c), which needs nothing but k(Y).
 * Positions follow from their velocities exactly, so that only these are iterated. Rates that say how fast they decay and oscillate shorten
 * what a residual adds.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "push/implicit-step.h"
#include "stream/limits.h"

enum { BASE = PM_IMPLICIT_BASE, TRIAL = PM_IMPLICIT_TRIAL, RESIDUAL = PM_IMPLICIT_RESIDUAL, MOST_ITERATIONS = 100 };

static const double converged = 1e-13; /* residual over state: a few hundred rounding errors */
static const double stalled = 1e-10;   /* below this a residual that no longer falls is rounding */
static const double tiny = 1e-140;     /* of what has decayed so far residuals below 1e-153 are none: their squares would underflow */

/* Does every rate depend on the particle alone? Terms of `field`, and of given fields. */
static bool alone(size_t n, const struct pm_moving *moving)
{
	bool own = true;
	for (size_t i = 0; i < n; i++)
		for (int r = 0; r < moving[i].n; r++)
			for (int t = 0; t < moving[i].rates[r].rate->nterms; t++)
				own = own && !strcmp(moving[i].rates[r].rate->terms[t], "external");
	return own;
}

static void residual(const struct pm_iterate *it)
{
	const double h = it->dt * it->scheme->part;
	for (int k = 0; k < it->lines; k++) {
		const struct pm_decided_line *l = it->line + k;
		double *restrict r = l->q[RESIDUAL];
		const double *base = l->q[BASE], *trial = l->q[TRIAL];
#pragma omp parallel for schedule(static) if (l->n > 16384)
		for (size_t i = 0; i < l->n; i++)
			r[i] = base[i] + h * l->k[i] - trial[i];
	}
}

/* y and x for the trial. beyond: as far beyond it as the step ends. column: from 1, value column - 1 of every particle is changed for a difference. */
static void place(const struct pm_frame *f, size_t n, const struct pm_moving *moving, const struct pm_iterate *it, double beyond, int column)
{
	const double h = beyond * it->dt * it->scheme->part;
	for (int k = 0, from = 0; k < it->lines; k++) {
		const struct pm_decided_line *l = it->line + k;
		from = l->moving == it->line[from].moving ? from : k;
		const bool changed = column > 0 && k == from + column - 1;
#pragma omp parallel for schedule(static) if (l->n > 16384)
		for (size_t i = 0; i < l->n; i++) {
			const double trial = l->q[TRIAL][i] + (changed ? pm_newton_change(it, k, i) : 0);
			if (l->x)
				l->x[i] = l->x_start[i] + h * trial;
			l->y[i] = beyond == 1 ? trial : l->q[BASE][i] + beyond * (trial - l->q[BASE][i]);
		}
	}
	pm_decided_fold(f, n, moving);
}

/* The first pass: the base, and a trial by the rate at the start, or with Newton's method the start. */
static void begin(struct pm_iterate *it, bool newton)
{
	const struct pm_implicit *s = it->scheme;
	for (int k = 0; k < it->lines; k++) {
		const struct pm_decided_line *l = it->line + k;
		const double a = it->dt * s->start, b = newton ? 0 : it->damp[k] * (s->start + s->part) * it->dt;
#pragma omp parallel for schedule(static) if (l->n > 16384)
		for (size_t i = 0; i < l->n; i++) {
			if (l->x)
				l->x_start[i] = l->x[i] + a * l->y[i];
			l->q[TRIAL][i] = l->y[i] + b * l->k[i];
			l->q[BASE][i] = l->y[i] + a * l->k[i];
		}
	}
}

/* Residual over state, the largest of all states; a residual that moves a position by less than a rounding error is none. Sets the weights of the lines. */
static double judge(struct pm_iterate *it)
{
	double worst = 0, most_of[3 * PM_IMPLICIT_LINES + 1], *size = most_of, *left = most_of + it->lines, *place = most_of + 2 * it->lines;
	for (int k = 0; k < it->lines; k++) {
		const struct pm_decided_line *l = it->line + k;
		size[k] = fmax(pm_decided_max(l->n, l->q[TRIAL]), pm_decided_max(l->n, l->q[BASE]));
		place[k] = l->x ? pm_decided_max(l->n, l->x) : 0;
		left[k] = pm_decided_max(l->n, l->q[RESIDUAL]);
	}
	if (it->lines)
		pm_decided_largest(it->line->rate->state, 3 * (size_t)it->lines, most_of);
	for (int k = 0; k < it->lines; k++) {
		if (it->line[k].x)
			size[k] = fmax(size[k], 1e-2 * place[k] / fabs(it->dt * it->scheme->part));
		it->small[k] = 1e-2 * (size[k] > 0 ? size[k] : left[k]);
	}
	for (int k = 0; k < it->lines; k++) {
		double scale = 0, most = 0;
		for (int j = 0; j < it->lines; j++)
			if (it->line[j].rate == it->line[k].rate)
				scale = fmax(scale, size[j]), most = fmax(most, left[j]);
		scale = fmax(scale, tiny);
		it->weight[k] = 1 / scale / scale;
		if (most > 0)
			worst = fmax(worst, isfinite(most) ? most / scale : INFINITY);
	}
	return worst;
}

/* A fixed point multiplies a residual by part dt (rate of decay), and where a position goes with it by its square for an oscillation. */
static void damp(struct pm_iterate *it)
{
	for (int k = 0; k < it->lines; k++) {
		const struct pm_limits limits = it->line[k].rate->rate->role == PM_CHANGE ? pm_limits_of(it->line[k].rate->rate) : (struct pm_limits){0};
		const double h = fabs(it->dt * it->scheme->part), turn = h * limits.oscillation;
		it->damp[k] = 1 / (1 + h * limits.decay + (it->line[k].x ? turn * turn : turn));
	}
}

static json_t *memory(int iteration, int column, double left)
{
	return json_pack("{s:i,s:i,s:f}", "iteration", iteration, "column", column, "residual", left);
}

/* The trial is the solution, or as near as rounding lets it come. */
static int take(struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_step *step, const struct pm_iterate *it, double left, bool newton,
	struct pm_controlled *done)
{
	*done = (struct pm_controlled){.completed = true, .iterations = it->number, .dt = f->dt, .next = f->dt, .error = left};
	done->beyond = newton ? pm_newton_beyond(it) : 0;
	place(f, n, moving, it, step->implicit->beyond, 0);
	pm_decided_drop(f, n, moving, 0);
	pm_decided_mark(f, n, moving, memory(0, 0, 0), 0, 1);
	return 0;
}

/* The next pass of Newton's method: another trial, or the next value for a difference. column: of this pass. */
static int newton(struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_step *step, struct pm_iterate *it, int column, double left,
	struct pm_controlled *done)
{
	const int columns = pm_newton_columns(it);
	if (column) {
		pm_newton_difference(it, column);
		if (column == columns)
			pm_newton_correct(it);
		column = column < columns ? column + 1 : 0;
	} else {
		const enum pm_newton next = pm_newton_judge(it, it->number == 1);
		if (next == PM_NEWTON_SOLVED)
			return take(f, n, moving, step, it, left, true, done);
		column = next == PM_NEWTON_DIFFERENCES;
	}
	place(f, n, moving, it, 1, column);
	pm_decided_mark(f, n, moving, memory(it->number, column, left), 1, step->implicit->at);
	return 0;
}

static int iterate(struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_step *step, struct pm_iterate *it, struct pm_controlled *done)
{
	const bool own = alone(n, moving), by_newton = own && pm_newton_can(it);
	const int most = by_newton ? MOST_ITERATIONS * (1 + pm_newton_columns(it)) : MOST_ITERATIONS;
	const double before = pm_decided_recall(moving, "residual");
	if (moving[0].pass.pass == 0) {
		begin(it, by_newton);
		place(f, n, moving, it, 1, 0);
		pm_decided_mark(f, n, moving, memory(0, 0, 0), 1, step->implicit->at);
		return 0;
	}
	it->number = (int)fmin(fmax(pm_decided_recall(moving, "iteration"), 0), most) + 1;
	const int column = by_newton ? (int)fmin(fmax(pm_decided_recall(moving, "column"), 0), PM_NEWTON_LINES) : 0;
	if (!by_newton)
		pm_anderson_residual(it);
	if (!column)
		residual(it);
	const double left = judge(it);
	if (!column && (left <= converged || (it->number > 2 && left < stalled && left >= 0.5 * before)))
		return take(f, n, moving, step, it, left, by_newton && it->number > 1, done);
	if ((!isfinite(left) && !(by_newton && it->number > 1)) || it->number >= most)
		return pm_fail(PM_NUMERICS, "the step from time %.9g: %d iterations of %s do not converge with dt %g (residual %.3g of the state, wanted %g; a "
			"shorter dt)", f->start, it->number, step->name, f->dt, left, converged);
	if (by_newton)
		return newton(f, n, moving, step, it, column, left, done);
	pm_anderson_correct(it, own);
	place(f, n, moving, it, 1, 0);
	pm_decided_mark(f, n, moving, memory(it->number, 0, left), 1, step->implicit->at);
	return 0;
}

int pm_implicit_run(struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_push *p, struct pm_controlled *done)
{
	struct pm_iterate it = {.scheme = p->scheme->implicit, .dt = f->dt};
	*done = (struct pm_controlled){0};
	it.lines = pm_decided_lines(n, moving, true, &it.line);
	int status = it.lines < 0 ? it.lines : 0;
	if (!status && it.lines > PM_IMPLICIT_LINES)
		status = pm_fail(PM_DATA, "%s iterates over at most %d components, and there are %d", p->scheme->name, PM_IMPLICIT_LINES, it.lines);
	if (!status)
		damp(&it);
	status = status ? status : iterate(f, n, moving, p->scheme, &it, done);
	free(it.line);
	return status;
}
