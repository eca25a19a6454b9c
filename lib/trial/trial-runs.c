/* The runs of a trial: the sentence with one choice changed, once or twice (trial-runs.h). SPDX-License-Identifier: GPL-3.0-or-later */
#include "trial/trial-runs.h"

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
	return PM_TRIAL_LEAST * pm_edit_cost(e, f, p) < pm_trial_budget;
}

bool pm_trial_ends(const struct pm_trials *t, struct pm_edit *e, char sentence[PM_PLAN_TEXT])
{
	char value[64];
	const int w = pm_edit_find(e, "dt", 0);
	snprintf(value, sizeof value, "%.17g", t->to);
	return (w < 0 || pm_edit_set(e, w, (struct pm_edit_option){"until", 0}, value)) && pm_edit_write(e, sentence);
}

void pm_trial_run_one(struct pm_trials *t, struct pm_alternative *a, struct pm_trial *r)
{
	const int64_t most = (int64_t)(8 * a->steps) * t->steps + 64;
	a->ran = pm_trial_ends(t, &a->edit, a->sentence) && !pm_plan_run_span(a->frame, a->sentence, t->middle, t->to, most, &a->run) &&
		fabs(a->run.end->time - t->to) <= 1e-6 * fabs(a->run.end->dt);
	r->evaluations += (double)a->run.steps * pm_edit_passes(&a->edit);
}
