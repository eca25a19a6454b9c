/* The equation of an implicit step by Newton's method, where every rate is one of `field` and so each particle has an equation of its own:
 * A s = R, A = 1 - part dt J, R the residual, Y + s the next trial. Column j of A comes from a pass of the sentence in which value j of every particle
 * is changed by a little, so one Jacobian of all particles takes as many passes as a particle has values. A is used again, corrected by what the last step
 * has shown (Broyden 1965), while the residual falls by 10 a step.
 * The first trial is the state at the start: the root that goes over into it as dt falls is sought, not any. A step is halved until the correction that A
 * foretells from its end is shorter than the step (natural monotonicity: Deuflhard 2004, section 3.3), each particle for itself.
 * On that root det A > 0, as long as it has not met another root or infinity on the way from dt = 0.
 * Source: Hairer and Wanner 1996, section IV.8. Cost per pass: the registers of a particle once through memory; m^3/3 operations a solution.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <float.h>

#include "push/implicit-step.h"
#include "world/world.h"

enum { RESIDUAL = PM_IMPLICIT_RESIDUAL, ROW = PM_IMPLICIT_OWN, STEP = ROW + PM_NEWTON_LINES, PART = STEP + 1, MOST = PM_NEWTON_LINES };

static const double least_part = 1.0 / 1024; /* of a step: then it is taken */
static const double below = 1e-13;           /* of the state: a correction that is none */
static const double slow = 0.1;              /* a correction over the last step: A is made anew */

struct solved {
	double s[MOST];
	bool negative; /* the determinant */
};

/* s of A s = R by elimination with the largest pivot of a column, rows over their largest entry; a pivot that is rounding counts as such. */
static struct solved solve(const struct pm_iterate *it, int from, int to, size_t p)
{
	const int m = to - from;
	double a[MOST][MOST + 1];
	struct solved done = {.negative = false};
	for (int i = 0; i < m; i++) {
		double *const *q = it->line[from + i].q;
		double most = 0;
		for (int j = 0; j < m; j++)
			most = fmax(most, fabs(a[i][j] = q[ROW + j][p]));
		a[i][m] = q[RESIDUAL][p];
		for (int j = 0; j <= m && most > 0; j++)
			a[i][j] /= most;
	}
	for (int j = 0; j < m; j++) {
		int at = j;
		for (int i = j + 1; i < m; i++)
			at = fabs(a[i][j]) > fabs(a[at][j]) ? i : at;
		for (int k = 0; k <= m && at != j; k++) {
			const double t = a[j][k];
			a[j][k] = a[at][k], a[at][k] = t;
		}
		done.negative ^= (at != j) ^ (a[j][j] < 0);
		if (fabs(a[j][j]) < DBL_EPSILON)
			a[j][j] = copysign(DBL_EPSILON, a[j][j]);
		for (int i = j + 1; i < m; i++)
			for (int k = m; k >= j; k--)
				a[i][k] -= a[i][j] / a[j][j] * a[j][k];
	}
	for (int i = m - 1; i >= 0; i--) {
		double sum = a[i][m];
		for (int k = i + 1; k < m; k++)
			sum -= a[i][k] * done.s[k];
		done.s[i] = sum / a[i][i];
	}
	return done;
}

/* Square of a length over that of the state. */
static double length2(const struct pm_iterate *it, int from, int to, const double s[MOST])
{
	double sum = 0;
	for (int k = from; k < to; k++)
		sum += it->weight[k] * s[k - from] * s[k - from];
	return sum;
}

static void go(const struct pm_iterate *it, int from, int to, size_t p, const double s[MOST])
{
	for (int k = from; k < to; k++) {
		double *const *q = it->line[k].q;
		q[STEP][p] = s[k - from];
		q[PM_IMPLICIT_TRIAL][p] += s[k - from];
	}
	it->line[from].q[PART][p] = 1;
}

/* The step of one particle is tried. -1: it is too long, and half of it is the next trial; otherwise the correction over it. */
static double tried(const struct pm_iterate *it, int from, int to, size_t p, double *correction)
{
	double *part = &it->line[from].q[PART][p], s[MOST];
	if (*part <= 0) { /* accepted before, and waiting for those that halve theirs */
		*correction = INFINITY;
		return 1;
	}
	for (int k = from; k < to; k++)
		s[k - from] = it->line[k].q[STEP][p];
	const struct solved next = solve(it, from, to, p);
	const double step = sqrt(length2(it, from, to, s)) / *part, left = sqrt(length2(it, from, to, next.s));
	if (!(left <= (1 - *part / 4) * step) && !(left <= below) && *part > least_part) {
		for (int k = from; k < to; k++) {
			double *const *q = it->line[k].q;
			q[STEP][p] /= 2;
			q[PM_IMPLICIT_TRIAL][p] -= q[STEP][p];
		}
		*part /= 2;
		return -1;
	}
	*correction = left;
	const double ratio = left <= below ? 0 : *part < 1 ? 1 : left / step;
	*part = -*part;
	return ratio;
}

/* Broyden's correction of A by a step that was taken: A s should have been R before less R now. */
static void learn(const struct pm_iterate *it, int from, int to, size_t p)
{
	double s[MOST];
	for (int k = from; k < to; k++)
		s[k - from] = it->line[k].q[STEP][p];
	const double square = length2(it, from, to, s);
	if (!(square > below * below)) /* rounding teaches nothing */
		return;
	for (int i = from; i < to; i++)
		for (int j = from; j < to; j++)
			it->line[i].q[ROW + j - from][p] -= it->line[i].q[RESIDUAL][p] * it->weight[j] * s[j - from] / square;
}

bool pm_newton_can(const struct pm_iterate *it) { return pm_newton_columns(it) <= PM_NEWTON_LINES; }

int pm_newton_columns(const struct pm_iterate *it)
{
	int most = 0;
	for (int from = 0, to; from < it->lines; from = to) {
		to = pm_iterate_set(it, from);
		most = to - from > most ? to - from : most;
	}
	return most;
}

enum pm_newton pm_newton_judge(struct pm_iterate *it, bool first)
{
	double worst = 0, most = 0;
	int halved = 0;
	if (first)
		return PM_NEWTON_DIFFERENCES;
	for (int from = 0, to; from < it->lines; from = to) {
		const size_t n = it->line[from].n;
		to = pm_iterate_set(it, from);
#pragma omp parallel for schedule(static) reduction(max : worst, most) reduction(| : halved) if (n > 4096)
		for (size_t p = 0; p < n; p++) {
			double correction = 0;
			const double ratio = tried(it, from, to, p, &correction);
			halved |= ratio < 0;
			worst = fmax(worst, ratio);
			most = fmax(most, correction);
		}
	}
	double all[] = {worst, most, halved};
	pm_decided_largest(it->line->rate->state, 3, all);
	worst = all[0], most = all[1];
	if (all[2] > 0)
		return PM_NEWTON_TRIAL;
	if (most <= below)
		return PM_NEWTON_SOLVED;
	if (worst > slow)
		return PM_NEWTON_DIFFERENCES;
	for (int from = 0, to; from < it->lines; from = to) {
		to = pm_iterate_set(it, from);
#pragma omp parallel for schedule(static) if (it->line[from].n > 4096)
		for (size_t p = 0; p < it->line[from].n; p++)
			learn(it, from, to, p);
	}
	pm_newton_correct(it);
	return PM_NEWTON_TRIAL;
}

double pm_newton_change(const struct pm_iterate *it, int line, size_t i)
{
	const double y = it->line[line].q[PM_IMPLICIT_TRIAL][i], d = copysign(sqrt(DBL_EPSILON) * fmax(fabs(y), it->small[line]), y);
	return (y + d) - y;
}

void pm_newton_difference(struct pm_iterate *it, int column)
{
	const double h = it->dt * it->scheme->part;
	for (int from = 0, to; from < it->lines; from = to) {
		to = pm_iterate_set(it, from);
		for (int k = from; k < to && column <= to - from; k++) {
			const struct pm_decided_line *l = it->line + k;
#pragma omp parallel for schedule(static) if (l->n > 16384)
			for (size_t i = 0; i < l->n; i++) {
				const double d = pm_newton_change(it, from + column - 1, i);
				const double slope = (l->q[PM_IMPLICIT_BASE][i] + h * l->k[i] - l->q[PM_IMPLICIT_TRIAL][i] - l->q[RESIDUAL][i]) / d;
				l->q[ROW + column - 1][i] = (k == from + column - 1) - (isfinite(slope) ? slope : 0);
			}
		}
	}
}

void pm_newton_correct(struct pm_iterate *it)
{
	for (int from = 0, to; from < it->lines; from = to) {
		to = pm_iterate_set(it, from);
#pragma omp parallel for schedule(static) if (it->line[from].n > 4096)
		for (size_t p = 0; p < it->line[from].n; p++) {
			const struct solved next = solve(it, from, to, p);
			go(it, from, to, p, next.s);
		}
	}
}

uint64_t pm_newton_beyond(const struct pm_iterate *it)
{
	uint64_t count = 0;
	for (int from = 0, to; from < it->lines; from = to) {
		to = pm_iterate_set(it, from);
#pragma omp parallel for schedule(static) reduction(+ : count) if (it->line[from].n > 4096)
		for (size_t p = 0; p < it->line[from].n; p++)
			count += solve(it, from, to, p).negative;
	}
	int64_t all = (int64_t)count;
	if (pm_world_count(0, PM_SUM_OF, 1, &all))
		pm_cannot_go_on();
	return (uint64_t)all;
}
