/* Runs of a sentence, each with one choice changed (trial.h); trial-judge.c says what their differences mean.
 * Cost: 15 to 40 runs of the tested part, whose length follows from a budget of estimated nanoseconds that no clock measures.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "trial/trial-runs.h"

static const double orbits = 1e9; /* instead of the budget for few bodies, whose error may come all at once, at a pericentre */

static bool affordable(const struct pm_trials *t, const struct pm_choice *c, const struct pm_alternative *a)
{
	bool finer = false;
	for (int i = 0; i < t->n; i++)
		finer = finer || t->alt[i].choice == &pm_choices[PM_CHOICE_MESH];
	if (c == &pm_choices[PM_CHOICE_COARSE] && finer)
		return false;
	return PM_TRIAL_LEAST * a->steps * pm_edit_cost(&a->edit, a->frame, t->p) < pm_trial_budget || (c->refines && c->kind == PM_TRIAL_TIME);
}

static void collect(struct pm_trials *t)
{
	for (const struct pm_choice *c = pm_choices; c->name && t->n < PM_TRIAL_ROWS; c++) {
		struct pm_alternative *a = &t->alt[t->n];
		if (pm_trial_alter(t, c, 1, a) != 1) /* no such choice, or this frame cannot be changed so */
			continue;
		if (affordable(t, c, a))
			t->n++;
		else
			pm_frame_free(a->frame);
	}
}

/* [ns] of all runs, for a step of the sentence. */
static double cost_of_all(const struct pm_trials *t)
{
	double ns = 2 * pm_edit_cost(&t->edit, t->f, t->p); /* some are refined twice */
	for (int i = 0; i < t->n; i++)
		ns += t->alt[i].steps * pm_edit_cost(&t->alt[i].edit, t->alt[i].frame, t->p);
	return ns;
}

static void leave_out(struct pm_trials *t, int i)
{
	pm_frame_free(t->alt[i].frame);
	t->n--;
	memmove(&t->alt[i], &t->alt[i + 1], (size_t)(t->n - i) * sizeof t->alt[0]);
}

/* How many steps of the sentence, all runs together within the budget. The other scheme is left out where the run is longer than that: half the step says the
 * same, and it takes up to 12 forces. */
static int64_t affordable_steps(struct pm_trials *t)
{
	const double most = t->p->scales.pairs && t->p->scales.sources < PM_DIGITS_FEW ? orbits : pm_trial_budget;
	if (!isnan(t->dt) && cost_of_all(t) * t->p->scales.time / fabs(t->dt) > most)
		for (int i = 0; i < t->n; i++)
			if (!strcmp(t->alt[i].choice->name, "scheme"))
				leave_out(t, i);
	return (int64_t)fmax(PM_TRIAL_LEAST, floor(most / cost_of_all(t)));
}

/* The sentence itself, and by it how far all of them run. */
static int run_base(struct pm_trials *t, int64_t steps, struct pm_trial *r)
{
	const double T = t->p->scales.time, sign = t->f->dt < 0 || t->dt < 0 ? -1 : 1;
	const int64_t most = steps ? steps : affordable_steps(t);
	r->all = isnan(t->dt) ? 0 : (int64_t)fmax(1, floor(T / fabs(t->dt) + 0.5));
	t->to = t->f->time + sign * (r->all && most < r->all ? (double)most * fabs(t->dt) : r->all ? (double)r->all * fabs(t->dt) : T);
	t->middle = t->f->time + (t->to - t->f->time) * (r->all ? floor(0.5 * (double)(most < r->all ? most : r->all)) / (double)(most < r->all ? most : r->all)
		: 0.5);
	if (!pm_trial_ends(t, &t->edit, t->sentence))
		return pm_fail(PM_USAGE, "the sentence is too long to be tested");
	const int status = pm_plan_run_span(t->f, t->sentence, t->middle, t->to, most, &t->base);
	if (status)
		return status;
	t->steps = r->steps = t->base.steps;
	t->to = t->base.end->time;
	r->part = fabs(t->to - t->f->time) / T;
	r->part = r->part > 1 - 1e-6 ? 1 : r->part;
	r->evaluations += (double)t->steps * pm_edit_passes(&t->edit);
	return pm_trial_ends(t, &t->edit, t->sentence) ? 0 : pm_fail(PM_USAGE, "the sentence is too long to be tested");
}

static void add_up(const struct pm_trials *t, struct pm_trial *r)
{
	const double accuracy = t->p->scales.accuracy;
	r->error = r->uncertain = 0;
	r->worst = -1;
	for (int kind = 0; kind < PM_TRIAL_KINDS; kind++) {
		int largest = -1;
		for (int i = 0; i < r->n; i++)
			if ((int)r->row[i].choice->kind == kind && !isnan(r->row[i].error) && (largest < 0 || r->row[i].error > r->row[largest].error))
				largest = i;
		if (largest < 0)
			continue;
		r->error += r->row[largest].error;
		r->uncertain += r->row[largest].uncertain;
		if (r->worst < 0 || r->row[largest].error > r->row[r->worst].error)
			r->worst = largest;
	}
	if (r->worst < 0) {
		r->verdict = PM_TRIAL_UNKNOWN; /* nothing could be compared */
		return;
	}
	r->verdict = r->error + r->uncertain <= accuracy ? PM_TRIAL_PASS : r->error - r->uncertain > accuracy ? PM_TRIAL_FAIL : PM_TRIAL_UNKNOWN;
}

int pm_trial_of(const struct pm_frame *f, const struct pm_plan *p, const char *sentence, int64_t steps, struct pm_trial *r)
{
	struct pm_trials *t = pm_alloc(1, sizeof *t);
	if (!t)
		return pm_failed();
	*t = (struct pm_trials){.f = f, .p = p};
	*r = (struct pm_trial){.of = pm_compare_what(f, p), .worst = -1};
	snprintf(r->sentence, sizeof r->sentence, "%s", sentence);
	int status = pm_edit_read(&t->edit, sentence) ? 0 : pm_fail(PM_USAGE, "the sentence is too long to be tested");
	if (!status) {
		t->dt = pm_edit_step(&t->edit, f);
		collect(t);
		status = run_base(t, steps, r);
	}
	for (int i = 0; i < t->n && !status; i++) {
		pm_trial_run_one(t, &t->alt[i], r);
		if (t->alt[i].choice->refines || !t->alt[i].ran)
			pm_trial_judge(t, &t->alt[i], r);
	}
	for (int i = 0; i < t->n && !status; i++) /* when the refined runs are known */
		if (!t->alt[i].choice->refines && t->alt[i].ran)
			pm_trial_judge(t, &t->alt[i], r);
	if (!status)
		add_up(t, r);
	for (int i = 0; i < t->n; i++)
		pm_frame_free(t->alt[i].frame), pm_plan_span_free(&t->alt[i].run);
	for (int i = 0; i < PM_TRIAL_KINDS; i++)
		pm_frame_free(t->again[i].frame), pm_plan_span_free(&t->again[i].run);
	pm_plan_span_free(&t->base);
	pm_free(t);
	return status;
}
