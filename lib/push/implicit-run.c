/* Implicit steps: Y = base + part dt k(Y), by a quasi-Newton iteration that needs nothing but k(Y), one pass of the sentence each: the last changes of Y and
 * of the residual R = base + part dt k(Y) - Y say what the inverse Jacobian does on the space they span, and the least residual in it is the next Y.
 * Source: Anderson 1965, J. ACM 12, 547, with up to 6 columns; for a linear rate the iterates are those of GMRES (Walker and Ni 2011).
 * The columns of a particle are its own where every rate is one of `field`, which depends on the particle alone: then each has its own Jacobian,
 * and converges as fast as if it were alone. Otherwise they are those of the whole state, and sums over all particles (compensated) weigh them.
 * Positions follow from their velocities exactly, so that only these are iterated. Rates that say how fast they decay and oscillate shorten
 * what a residual adds.
 * Cost per pass: the registers twice through memory; six columns, 27 sums.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "push/decided-step.h"
#include "stream/limits.h"

enum { BASE, TRIAL, RESIDUAL, STEPS, CHANGES = STEPS + PM_IMPLICIT_DEPTH, DEPTH = PM_IMPLICIT_DEPTH, MOST_ITERATIONS = 100, MOST_LINES = 192 };

static const double converged = 1e-13; /* residual over state: a few hundred rounding errors */
static const double stalled = 1e-10;   /* below this a residual that no longer falls is rounding */
static const double tiny = 1e-140;     /* of what has decayed so far residuals below 1e-153 are none: their squares would underflow */
static const double dependent = 1e-14; /* square of the sine of the angle below which a column says nothing new: rounding of the products */

struct iteration {
	const struct pm_implicit *scheme;
	double dt;
	int number, columns; /* of this iteration, from 1; of changes known */
	int lines;
	struct pm_decided_line *line;
	double damp[MOST_LINES], weight[MOST_LINES]; /* of each line */
};

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

/* The slot of the j-th newest column. */
static int slot(const struct iteration *it, int j) { return (it->number - 2 - j + 2 * DEPTH) % DEPTH; }

/* gamma minimises |r - sum gamma_j c_j|^2, from the products g_ij = c_i c_j, b_j = c_j r: Cholesky, newest column first, without dependent ones. */
static void least(int m, double g[DEPTH][DEPTH], const double b[DEPTH], double gamma[DEPTH])
{
	double l[DEPTH][DEPTH] = {{0}}, z[DEPTH];
	for (int j = 0; j < m; j++) {
		double d = g[j][j];
		z[j] = b[j];
		for (int k = 0; k < j; k++) {
			double sum = g[j][k];
			for (int q = 0; q < k; q++)
				sum -= l[j][q] * l[k][q];
			l[j][k] = l[k][k] > 0 ? sum / l[k][k] : 0;
			d -= l[j][k] * l[j][k];
			z[j] -= l[j][k] * z[k];
		}
		l[j][j] = d > dependent * g[j][j] ? sqrt(d) : 0;
		z[j] = l[j][j] > 0 ? z[j] / l[j][j] : 0;
	}
	for (int j = m - 1; j >= 0; j--) {
		double sum = z[j];
		for (int k = j + 1; k < m; k++)
			sum -= l[k][j] * gamma[k];
		gamma[j] = l[j][j] > 0 ? sum / l[j][j] : 0;
	}
}

/* The residual and what it has changed by. */
static void residual(const struct iteration *it, const struct pm_decided_line *l)
{
	const double h = it->dt * it->scheme->part;
	double *restrict r = l->q[RESIDUAL], *restrict change = it->number > 1 ? l->q[CHANGES + slot(it, 0)] : NULL;
	const double *base = l->q[BASE], *trial = l->q[TRIAL];
#pragma omp parallel for schedule(static) if (l->n > 16384)
	for (size_t i = 0; i < l->n; i++) {
		const double now = base[i] + h * l->k[i] - trial[i];
		if (change)
			change[i] = now - r[i];
		r[i] = now;
	}
}

/* The next trial of one value: gamma[j] of each column. */
static inline void next(const struct iteration *it, const struct pm_decided_line *l, double damp, const double gamma[DEPTH], size_t i)
{
	double step = damp * l->q[RESIDUAL][i];
	for (int j = 0; j < it->columns; j++)
		step -= gamma[j] * (l->q[STEPS + slot(it, j)][i] + damp * l->q[CHANGES + slot(it, j)][i]);
	l->q[STEPS + (it->number - 1) % DEPTH][i] = step;
	l->q[TRIAL][i] += step;
}

/* All values of all lines, with one set of coefficients. */
static void together(struct iteration *it)
{
	double g[DEPTH][DEPTH] = {{0}}, b[DEPTH] = {0}, gamma[DEPTH] = {0};
	for (int k = 0; k < it->lines; k++) {
		const struct pm_decided_line *l = it->line + k;
		for (int i = 0; i < it->columns; i++) {
			b[i] += it->weight[k] * pm_sum_products(l->n, l->q[CHANGES + slot(it, i)], l->q[RESIDUAL]);
			for (int j = 0; j <= i; j++)
				g[i][j] += it->weight[k] * pm_sum_products(l->n, l->q[CHANGES + slot(it, i)], l->q[CHANGES + slot(it, j)]);
		}
	}
	least(it->columns, g, b, gamma);
	for (int k = 0; k < it->lines; k++) {
		const struct pm_decided_line *l = it->line + k;
#pragma omp parallel for schedule(static) if (l->n > 16384)
		for (size_t i = 0; i < l->n; i++)
			next(it, l, it->damp[k], gamma, i);
	}
}

/* Each particle with its own; lines from..to-1 belong to one set. */
static void apart(struct iteration *it, int from, int to)
{
	const size_t n = it->line[from].n;
#pragma omp parallel for schedule(static) if (n > 4096)
	for (size_t p = 0; p < n; p++) {
		double g[DEPTH][DEPTH] = {{0}}, b[DEPTH] = {0}, gamma[DEPTH] = {0};
		for (int k = from; k < to; k++) {
			double *const *q = it->line[k].q;
			for (int i = 0; i < it->columns; i++) {
				const double c = it->weight[k] * q[CHANGES + slot(it, i)][p];
				b[i] += c * q[RESIDUAL][p];
				for (int j = 0; j <= i; j++)
					g[i][j] += c * q[CHANGES + slot(it, j)][p];
			}
		}
		least(it->columns, g, b, gamma);
		for (int k = from; k < to; k++)
			next(it, it->line + k, it->damp[k], gamma, p);
	}
}

/* y and x for the trial; beyond: as far beyond it as the step ends. */
static void place(const struct pm_frame *f, size_t n, const struct pm_moving *moving, const struct iteration *it, double beyond)
{
	const double h = beyond * it->dt * it->scheme->part;
	for (int k = 0; k < it->lines; k++) {
		const struct pm_decided_line *l = it->line + k;
#pragma omp parallel for schedule(static) if (l->n > 16384)
		for (size_t i = 0; i < l->n; i++) {
			if (l->x)
				l->x[i] = l->x_start[i] + h * l->q[TRIAL][i];
			l->y[i] = beyond == 1 ? l->q[TRIAL][i] : l->q[BASE][i] + beyond * (l->q[TRIAL][i] - l->q[BASE][i]);
		}
	}
	pm_decided_fold(f, n, moving);
}

/* The first pass: the base, and a trial by the rate at the start. */
static void begin(struct iteration *it)
{
	const struct pm_implicit *s = it->scheme;
	for (int k = 0; k < it->lines; k++) {
		const struct pm_decided_line *l = it->line + k;
		const double a = it->dt * s->start, b = it->damp[k] * (s->start + s->part) * it->dt;
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
static double judge(struct iteration *it)
{
	double worst = 0, size[MOST_LINES], left[MOST_LINES];
	for (int k = 0; k < it->lines; k++) {
		const struct pm_decided_line *l = it->line + k;
		residual(it, l);
		size[k] = fmax(pm_decided_max(l->n, l->q[TRIAL]), pm_decided_max(l->n, l->q[BASE]));
		if (l->x)
			size[k] = fmax(size[k], 1e-2 * pm_decided_max(l->n, l->x) / fabs(it->dt * it->scheme->part));
		left[k] = pm_decided_max(l->n, l->q[RESIDUAL]);
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

static void correct(struct iteration *it, bool own)
{
	if (!own) {
		together(it);
		return;
	}
	for (int from = 0, to; from < it->lines; from = to) {
		for (to = from; to < it->lines && it->line[to].moving == it->line[from].moving; to++)
			;
		apart(it, from, to);
	}
}

/* A fixed point multiplies a residual by part dt (rate of decay), and where a position goes with it by its square for an oscillation. */
static void damp(struct iteration *it)
{
	for (int k = 0; k < it->lines; k++) {
		const struct pm_limits limits = it->line[k].rate->rate->role == PM_CHANGE ? pm_limits_of(it->line[k].rate->rate) : (struct pm_limits){0};
		const double h = fabs(it->dt * it->scheme->part), turn = h * limits.oscillation;
		it->damp[k] = 1 / (1 + h * limits.decay + (it->line[k].x ? turn * turn : turn));
	}
}

static json_t *memory(int iteration, double left)
{
	return json_pack("{s:i,s:f}", "iteration", iteration, "residual", left);
}

static int iterate(struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_step *step, struct iteration *it, struct pm_controlled *done)
{
	const double before = pm_decided_recall(moving, "residual");
	if (moving[0].pass.pass == 0) {
		begin(it);
		place(f, n, moving, it, 1);
		pm_decided_mark(f, n, moving, memory(0, 0), 1, step->implicit->at);
		return 0;
	}
	it->number = (int)fmin(fmax(pm_decided_recall(moving, "iteration"), 0), MOST_ITERATIONS) + 1;
	it->columns = it->number - 1 < DEPTH ? it->number - 1 : DEPTH;
	const double left = judge(it);
	if (left <= converged || (it->number > 2 && left < stalled && left >= 0.5 * before)) {
		*done = (struct pm_controlled){.completed = true, .iterations = it->number, .dt = f->dt, .next = f->dt, .error = left};
		place(f, n, moving, it, step->implicit->beyond);
		pm_decided_drop(f, n, moving, 0);
		pm_decided_mark(f, n, moving, memory(0, 0), 0, 1);
		return 0;
	}
	if (!isfinite(left) || it->number >= MOST_ITERATIONS)
		return pm_fail(PM_NUMERICS, "the step from time %.9g: %d iterations of %s do not converge with dt %g (residual %.3g of the state, wanted %g; a "
			"shorter dt)", f->start, it->number, step->name, f->dt, left, converged);
	correct(it, alone(n, moving));
	place(f, n, moving, it, 1);
	pm_decided_mark(f, n, moving, memory(it->number, left), 1, step->implicit->at);
	return 0;
}

int pm_implicit_run(struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_push *p, struct pm_controlled *done)
{
	struct iteration it = {.scheme = p->scheme->implicit, .dt = f->dt};
	*done = (struct pm_controlled){0};
	it.lines = pm_decided_lines(n, moving, true, &it.line);
	int status = it.lines < 0 ? it.lines : 0;
	if (!status && it.lines > MOST_LINES)
		status = pm_fail(PM_DATA, "%s iterates over at most %d components, and there are %d", p->scheme->name, MOST_LINES, it.lines);
	if (!status)
		damp(&it);
	status = status ? status : iterate(f, n, moving, p->scheme, &it, done);
	free(it.line);
	return status;
}
