/* Runs of a sentence, each with one choice changed (trial.h); trial-judge.c says what their differences mean.
 * Cost: 15 to 40 runs of the tested part, whose length follows from a budget of estimated nanoseconds that no clock measures.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "planner/trial-runs.h"

/* Of one core, with all words of a sentence: a pair, a point of the mesh, a particle, a pass. */
static const double ns_pair = 0.39, ns_point = 40, ns_particle = 150, ns_pass = 2e4;
static const double orbits = 1e9; /* instead of the budget for few bodies, whose error may come all at once, at a pericentre */
enum { LEAST_STEPS = 4 };

double pm_trial_cost(const struct pm_edit *e, const struct pm_frame *f, const struct pm_plan *p)
{
	const struct pm_scales *s = &p->scales;
	const double points = pm_choice_points(e, f), open = s->open ? pow(2, f->dim) : 1, slow = pm_edit_find(e, "poisson-mg", 0) >= 0 ? 4 : 1;
	const double pairs = pm_edit_find(e, "pp", 0) >= 0 ? ns_pair * s->n * s->sources : 0;
	return pm_choice_passes(e) * (ns_pass + ns_particle * s->n + ns_point * points * open * slow + pairs);
}

/* 1: there is such an alternative; 0: none; failure. */
int pm_trial_alter(const struct pm_trials *t, const struct pm_choice *c, int times, struct pm_alternative *a)
{
	char from[48];
	*a = (struct pm_alternative){.choice = c, .edit = t->edit, .frame = pm_plan_bare(t->f), .steps = 1};
	int status = a->frame ? 1 : -PM_DATA;
	for (int i = 0; i < times && status == 1; i++)
		status = c->alter(t->p, &a->edit, &a->frame, i ? from : a->from, a->to);
	if (status == 1 && c->refines && c->kind == PM_TRIAL_TIME)
		a->steps = pow(2, times);
	if (status == 1 && !pm_edit_write(&a->edit, a->sentence))
		status = 0;
	if (status != 1)
		a->frame = pm_frame_free(a->frame);
	return status;
}

bool pm_trial_affordable(const struct pm_edit *e, const struct pm_frame *f, const struct pm_plan *p)
{
	return LEAST_STEPS * pm_trial_cost(e, f, p) < pm_trial_budget;
}

static bool affordable(const struct pm_trials *t, const struct pm_choice *c, const struct pm_alternative *a)
{
	bool finer = false;
	for (int i = 0; i < t->n; i++)
		finer = finer || t->alt[i].choice == &pm_choices[PM_CHOICE_MESH];
	if (c == &pm_choices[PM_CHOICE_COARSE] && finer)
		return false;
	return LEAST_STEPS * a->steps * pm_trial_cost(&a->edit, a->frame, t->p) < pm_trial_budget || (c->refines && c->kind == PM_TRIAL_TIME);
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
	double ns = 2 * pm_trial_cost(&t->edit, t->f, t->p); /* some are refined twice */
	for (int i = 0; i < t->n; i++)
		ns += t->alt[i].steps * pm_trial_cost(&t->alt[i].edit, t->alt[i].frame, t->p);
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
	return (int64_t)fmax(LEAST_STEPS, floor(most / cost_of_all(t)));
}

/* Words that set dt themselves end their run at t->to. */
static bool ends(struct pm_trials *t, struct pm_edit *e, char sentence[PM_PLAN_TEXT])
{
	char value[64];
	const int w = pm_edit_find(e, "dt", 0);
	snprintf(value, sizeof value, "%.17g", t->to);
	return (w < 0 || pm_edit_set(e, w, (struct pm_edit_option){"until", 0}, value)) && pm_edit_write(e, sentence);
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
	if (!ends(t, &t->edit, t->sentence))
		return pm_fail(PM_USAGE, "the sentence is too long to be tested");
	const int status = pm_trial_run(t->f, t->sentence, t->middle, t->to, most, &t->base);
	if (status)
		return status;
	t->steps = r->steps = t->base.steps;
	t->to = t->base.end->time;
	r->part = fabs(t->to - t->f->time) / T;
	r->part = r->part > 1 - 1e-6 ? 1 : r->part;
	r->evaluations += (double)t->steps * pm_choice_passes(&t->edit);
	return ends(t, &t->edit, t->sentence) ? 0 : pm_fail(PM_USAGE, "the sentence is too long to be tested");
}

void pm_trial_run_one(struct pm_trials *t, struct pm_alternative *a, struct pm_trial *r)
{
	const int64_t most = (int64_t)(8 * a->steps) * t->steps + 64;
	a->ran = ends(t, &a->edit, a->sentence) && !pm_trial_run(a->frame, a->sentence, t->middle, t->to, most, &a->run) &&
		fabs(a->run.end->time - t->to) <= 1e-6 * fabs(a->run.end->dt);
	r->evaluations += (double)a->run.steps * pm_choice_passes(&a->edit);
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
		t->dt = pm_choice_step(&t->edit, f);
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
		pm_frame_free(t->alt[i].frame), pm_trial_run_free(&t->alt[i].run);
	for (int i = 0; i < PM_TRIAL_KINDS; i++)
		pm_frame_free(t->again[i].frame), pm_trial_run_free(&t->again[i].run);
	pm_trial_run_free(&t->base);
	pm_free(t);
	return status;
}
