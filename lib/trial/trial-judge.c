/* The error of a sentence, from the differences between its run and those with one choice changed.
 *   A refinement by 2 of order p changes the result by d: the error of the sentence is d/(1 - 2^-p) (Richardson 1911), uncertain by what one order less
 *   would give. Where that is near the accuracy a second refinement gives d', and d/d' takes the place of 2^p (Roache 1998, 5.3).
 *   Another scheme, kernel, gradient or solver is no better in itself. Its change is an error of the sentence only if it comes nearer to the refined run.
 *   Half of the particles, each twice as strong: the whole is the mean of two halves, so a half differs from it by as much as the whole from the mean of
 *   infinitely many; both fall as n^-1/2.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "trial/trial-runs.h"

static double between(const struct pm_trials *t, const struct pm_plan_span *a, const struct pm_plan_span *b, const char *of)
{
	const struct pm_frame *const scaled[3] = {t->f, t->base.half, t->base.end};
	return pm_compare(a->end, b->end, scaled, t->p, of);
}

/* The growth from the tested part to the whole run: as a power of time between 1 and 2, taken from the middle and the end of the part. */
static double grown(const struct pm_trials *t, const struct pm_alternative *a, const struct pm_trial *r, double difference)
{
	const struct pm_frame *const scaled[3] = {t->f, t->base.half, t->base.end};
	double q = 1;
	if (a->run.half && t->base.half && !isnan(t->dt) && r->part < 1) {
		const double d = pm_compare(a->run.half, t->base.half, scaled, t->p, r->of), ratio = (t->to - t->f->time) / (t->middle - t->f->time);
		q = d > 0 && ratio > 1 ? fmin(2, fmax(1, log(difference / d) / log(ratio))) : 1;
	}
	return pow(1 / r->part, q);
}

/* The error of a sentence that refinement by 2 changes by d, and what one order less would add. */
static void richardson(double d, double p, struct pm_trial_row *row)
{
	row->error = d / (1 - pow(2, -p));
	row->uncertain = d / (1 - pow(2, -fmax(p - 1, 0.5))) - row->error;
}

static double order_of(const struct pm_trials *t, const struct pm_choice *c)
{
	return c->kind == PM_TRIAL_TIME ? pm_edit_order(&t->edit) : pm_plan_nodes(t->p) ? 4 /* m6prime */ : 2;
}

/* The same from a mesh twice as coarse. */
static void by_coarse(struct pm_trial_row *row, double p)
{
	row->error = row->difference / fmax(1, pow(2, p) - 1);
	row->uncertain = row->error;
}

/* A third run where two cannot decide. */
static void refine_twice(struct pm_trials *t, struct pm_alternative *a, struct pm_trial *r, struct pm_trial_row *row)
{
	struct pm_alternative *b = &t->again[a->choice->kind];
	const double p = order_of(t, a->choice);
	const bool coarse = a->choice == &pm_choices[PM_CHOICE_COARSE];
	if (row->error + row->uncertain < 0.25 * t->p->scales.accuracy / grown(t, a, r, row->difference) || pm_trial_alter(t, a->choice, 2, b) != 1)
		return;
	if (a->choice->kind != PM_TRIAL_TIME && (double)t->steps * pm_edit_cost(&b->edit, b->frame, t->p) > pm_trial_budget)
		return;
	pm_trial_run_one(t, b, r);
	if (!b->ran)
		return;
	const double next = between(t, &b->run, &a->run, r->of), ratio = coarse ? next / row->difference : row->difference / next;
	if (isnan(next))
		return;
	row->order = log2(ratio);
	if (coarse) {
		by_coarse(row, fmin(p, row->order));
		return;
	}
	if (ratio > 1.4) { /* half an order at least */
		const double by_order = row->error;
		richardson(row->difference, fmin(row->order, p + 1), row);
		row->uncertain = fmin(row->uncertain, fabs(row->error - by_order) + 0.1 * row->error);
	} else {
		row->error = fmax(row->difference, next);
		row->uncertain = row->error / 2;
	}
}

static void judge_refined(struct pm_trials *t, struct pm_alternative *a, struct pm_trial *r, struct pm_trial_row *row)
{
	richardson(row->difference, order_of(t, a->choice), row);
	if (a->choice == &pm_choices[PM_CHOICE_COARSE])
		by_coarse(row, order_of(t, a->choice));
	refine_twice(t, a, r, row);
	if (row->order < 0.5)
		snprintf(row->text, sizeof row->text, "does not converge");
	else if (!isnan(row->order))
		snprintf(row->text, sizeof row->text, "order %.1f", row->order);
	else
		snprintf(row->text, sizeof row->text, "order %.0f taken", order_of(t, a->choice));
}

/* Nearer to the refined run than the sentence is? */
static void judge_other(struct pm_trials *t, struct pm_alternative *a, struct pm_trial *r, struct pm_trial_row *row)
{
	const struct pm_alternative *fine = NULL;
	for (int i = 0; i < t->n; i++)
		if (t->alt[i].ran && t->alt[i].choice->refines && t->alt[i].choice->kind == a->choice->kind &&
			t->alt[i].choice != &pm_choices[PM_CHOICE_COARSE])
			fine = &t->alt[i];
	const double own = fine ? between(t, &t->base, &fine->run, r->of) : NAN, its = fine ? between(t, &a->run, &fine->run, r->of) : NAN;
	if (!strcmp(a->choice->name, "pairs")) {
		row->error = row->difference;
		row->uncertain = 0.1 * row->error; /* pairs have round-off alone */
		snprintf(row->text, sizeof row->text, "exact");
	} else if (its < own) {
		row->error = row->difference;
		row->uncertain = its;
		snprintf(row->text, sizeof row->text, "nearer to the finer run");
	} else if (isnan(own) || isnan(its)) {
		snprintf(row->text, sizeof row->text, "no finer run to compare with");
	} else {
		snprintf(row->text, sizeof row->text, "farther from the finer run: %.2g", its);
	}
}

/* A quarter against the half: random noise gives sqrt(2) times as much; a regular load converges faster, as a power of n. */
static void judge_sampling(struct pm_trials *t, struct pm_alternative *a, struct pm_trial *r, struct pm_trial_row *row)
{
	struct pm_alternative *b = &t->again[PM_TRIAL_SAMPLING];
	double ratio = NAN;
	if (row->difference > 0.25 * t->p->scales.accuracy && pm_trial_alter(t, a->choice, 2, b) == 1) {
		pm_trial_run_one(t, b, r);
		ratio = b->ran ? between(t, &b->run, &a->run, r->of) / row->difference : NAN;
	}
	row->error = row->difference / fmax(1, ratio - 1); /* fmax ignores NAN */
	row->uncertain = 0.5 * row->error; /* of one half */
	snprintf(row->text, sizeof row->text, ratio > 2 ? "regular, as n^-%.1f" : "noise, as n^-1/2", log2(fmax(1, ratio)));
}

void pm_trial_judge(struct pm_trials *t, struct pm_alternative *a, struct pm_trial *r)
{
	struct pm_trial_row *row = &r->row[r->n++];
	*row = (struct pm_trial_row){.choice = a->choice, .difference = NAN, .error = NAN, .uncertain = NAN, .order = NAN};
	memcpy(row->from, a->from, sizeof row->from);
	memcpy(row->to, a->to, sizeof row->to);
	row->difference = a->ran ? between(t, &a->run, &t->base, r->of) : NAN;
	if (isnan(row->difference)) {
		snprintf(row->text, sizeof row->text, a->ran ? "cannot be compared" : "cannot run: %.120s", pm_message());
		return;
	}
	switch (a->choice->kind) {
	case PM_TRIAL_SAMPLING:
		judge_sampling(t, a, r, row);
		break;
	case PM_TRIAL_ROUNDING:
		row->error = row->difference;
		row->uncertain = 0;
		snprintf(row->text, sizeof row->text, "%.1f digits agree", row->difference > 0 ? fmax(0, -log10(row->difference)) : 16);
		return; /* it grows exponentially where it grows: no power of time leads to the end */
	default:
		(a->choice->refines ? judge_refined : judge_other)(t, a, r, row);
	}
	const double more = grown(t, a, r, row->difference);
	row->uncertain = row->uncertain * more + fabs(more - 1 / r->part) * row->error;
	row->error *= more;
}
