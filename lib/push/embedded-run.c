/* Steps of an embedded pair: every stage is a pass, and keeps its rate in a register; the last one knows the error of the step, takes it or begins it anew
 * with a shorter one (the rate at its start is known). The error of a state is the largest over particles of the length of the difference of the two members,
 * over the root of the mean square of the state at the start or the end, whichever is larger; that of the step is the largest over all states and sets.
 * Step length by proportional and integral control: dt 0.9 (tolerance/e)^(0.7/p) (e of the last step/tolerance)^(0.4/p), p = order + 1,
 * from 1/5 to 5 times the last, none longer after a rejection (Gustafsson 1991; Hairer and Wanner 1996, section IV.2). Sums are compensated;
 * the same bytes for any number of threads and ranks.
 * With dense output wanted the registers stay until the next step, and the state at a time in between is a polynomial of order `order` in them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "push/decided-step.h"
#include "push/step-choice.h"
#include "stream/over-stretches.h"

enum { START, RATES };

static const double tiny = 1e-300; /* of what has decayed so far errors below 1e-150 are none: squares would underflow */

static void keep(const struct pm_decided_line *l, int stage)
{
	if (!stage)
		memcpy(l->q[START], l->y, l->n * sizeof *l->y);
	memcpy(l->q[RATES + stage], l->k, l->n * sizeof *l->k);
}

/* The state for this stage: y + dt sum a k. */
static void place(const struct pm_embedded *e, const struct pm_decided_line *l, int stage, double dt)
{
#pragma omp parallel for schedule(static) if (l->n > 16384)
	for (size_t i = 0; i < l->n; i++) {
		double sum = 0;
		for (int j = 0; j < stage; j++)
			sum += e->a[stage][j] * l->q[RATES + j][i];
		l->y[i] = l->q[START][i] + dt * sum;
	}
}

/* Of one state, lines from..to-1: the largest difference of a particle over the size of the state. */
static double square_of(const struct pm_decided_line *l, const double *y)
{
	struct pm_sum sum = {0, 0};
	pm_sum_of_stretches(l->rate->state, y, y, &sum);
	return pm_sum_total(sum);
}

static double error_of(const struct pm_embedded *e, const struct pm_decided_line *l, int lines, double dt)
{
	double most = 0, first = 0, last = 0;
	const size_t n = l->n;
	for (int k = 0; k < lines; k++) {
		first += square_of(l + k, l[k].q[START]);
		last += square_of(l + k, l[k].y);
	}
#pragma omp parallel for schedule(static) reduction(max : most) if (n > 16384)
	for (size_t i = 0; i < n; i++) {
		double square = 0;
		for (int k = 0; k < lines; k++) {
			double sum = 0;
			for (int j = 0; j < e->stages; j++)
				sum += e->error[j] * l[k].q[RATES + j][i];
			square += dt * sum * (dt * sum);
		}
		most = isnan(square) ? INFINITY : fmax(most, square);
	}
	const double size = fmax(first, last);
	pm_decided_largest(l->rate->state, 1, &most);
	return most > tiny ? sqrt(most * (double)l->moving->set->n / size) : 0;
}

static double error(const struct pm_embedded *e, int lines, const struct pm_decided_line *l, double dt)
{
	double worst = 0;
	for (int from = 0, to; from < lines; from = to) {
		for (to = from; to < lines && l[to].rate == l[from].rate; to++)
			;
		const double one = error_of(e, l + from, to - from, dt);
		worst = isnan(one) ? INFINITY : fmax(worst, one);
	}
	return worst;
}

int pm_embedded_run(struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_push *p, struct pm_controlled *done)
{
	const struct pm_embedded *e = p->scheme->embedded;
	const int stage = moving[0].pass.pass;
	struct pm_decided_line *line;
	const int lines = pm_decided_lines(n, moving, false, &line);
	struct pm_choice choice = pm_choice_recall(moving, p->scheme);
	int status = lines < 0 ? lines : 0, next = stage + 1;
	*done = (struct pm_controlled){0};
	for (int k = 0; k < lines; k++)
		keep(line + k, stage);
	if (!status && next == e->stages) {
		done->error = error(e, lines, line, f->dt);
		status = pm_choice_of(f, p, e->order, &choice, done);
		next = done->rejected ? 1 : 0;
	}
	for (int k = 0; k < lines && next && !status; k++)
		place(e, line + k, next, f->dt);
	free(line);
	if (status)
		return status;
	if (next)
		pm_decided_fold(f, n, moving);
	else if (!p->dense)
		pm_decided_drop(f, n, moving, 0);
	pm_choice_take(f, n, moving, &choice, next, next ? e->at[next] : 1, done);
	return 0;
}
