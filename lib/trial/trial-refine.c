/* A sentence refined where it fails, until it passes: the step by as much as its order asks for, the mesh by 2, or a kernel, gradient, solver or scheme that
 * came nearer to the refined run. Greedy: one choice in each try. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "trial/trial.h"

static const double dearest = 8e9; /* [ns] of one trial, estimated */

/* The largest error that some choice can reduce. */
static const struct pm_trial_row *culprit(const struct pm_trial *t)
{
	const struct pm_trial_row *found = NULL;
	for (int i = 0; i < t->n; i++) {
		const struct pm_trial_row *r = &t->row[i];
		if (r->choice->kind <= PM_TRIAL_SPACE && !isnan(r->error) && (!found || r->error > found->error))
			found = r;
	}
	return found;
}

static double sum_of(const struct pm_trial *t, enum pm_trial_kind kind)
{
	double e = 0;
	for (int i = 0; i < t->n; i++)
		if (t->row[i].choice->kind == kind && t->row[i].error > e)
			e = t->row[i].error;
	return e;
}

static int change(const struct pm_frame *f, const struct pm_plan *p, const struct pm_choice *c, int times, struct pm_edit *e)
{
	char from[48], to[48];
	struct pm_frame *g = pm_plan_bare(f);
	int status = g ? 1 : pm_failed();
	for (int i = 0; i < times && status == 1; i++)
		status = c->alter(p, e, &g, from, to);
	pm_frame_free(g);
	return status;
}

/* What limits the error that no sentence reduces: "" if there is none. */
static void given(const struct pm_trial *t, const struct pm_plan *p, char why[200])
{
	const double accuracy = p->scales.accuracy;
	if (sum_of(t, PM_TRIAL_ROUNDING) > accuracy)
		snprintf(why, 200, "rounding and chaos forbid this accuracy: input moved in its last bit changes %s by %.2g", t->of,
			sum_of(t, PM_TRIAL_ROUNDING));
	else if (sum_of(t, PM_TRIAL_SAMPLING) > accuracy)
		snprintf(why, 200, "the noise of %g particles is %.2g (about %.0f times as many: pinit -n)", p->scales.n, sum_of(t, PM_TRIAL_SAMPLING),
			ceil(pow(sum_of(t, PM_TRIAL_SAMPLING) / (0.5 * accuracy), 2)));
	else if (pm_plan_nodes(p) && culprit(t) && culprit(t)->choice->kind == PM_TRIAL_SPACE)
		snprintf(why, 200, "the particles of the frame are the nodes of the mesh, and a finer one needs more of them (pinit --cells)");
}

int pm_trial_refine(const struct pm_frame *f, const struct pm_plan *p, const struct pm_trial *first, struct pm_trial *last, char why[200])
{
	struct pm_edit e;
	char sentence[PM_PLAN_TEXT];
	*last = *first;
	why[0] = 0;
	for (int try = 0; try < PM_REFINE_TRIES && last->verdict != PM_TRIAL_PASS; try++) {
		const struct pm_trial_row *row = culprit(last);
		given(last, p, why);
		if (*why || !row || !pm_edit_read(&e, last->sentence))
			break;
		/* to 0.4 of the accuracy: uncertainty and the other kinds need room */
		const bool step = row->choice == &pm_choices[PM_CHOICE_STEP];
		const double order = fmax(1, isnan(row->order) ? 2 : row->order), halvings = ceil(log2(row->error / (0.4 * p->scales.accuracy)) / order);
		const struct pm_choice *c = row->choice == &pm_choices[PM_CHOICE_COARSE] ? &pm_choices[PM_CHOICE_MESH] : row->choice;
		const int status = change(f, p, c, step ? (int)fmin(6, fmax(1, halvings)) : 1, &e);
		if (status < 0)
			return status;
		if (!status || !pm_edit_write(&e, sentence))
			break;
		const double halved = step ? pow(2, fmin(6, fmax(1, halvings))) : 1, steps = (double)last->steps * halved;
		if (!pm_trial_affordable(&e, f, p) || 5 * steps * pm_edit_cost(&e, f, p) > dearest) {
			snprintf(why, 200, "error %.2g +- %.1g, and the next refinement is beyond the cost of a trial: %.100s", last->error,
				last->uncertain, sentence);
			break;
		}
		if (pm_trial_of(f, p, sentence, (int64_t)steps, last)) { /* over the same time */
			snprintf(why, 200, "the refined sentence fails: %.150s", pm_message());
			break;
		}
	}
	if (last->verdict != PM_TRIAL_PASS && !*why)
		snprintf(why, 200, "%d refinements leave an error of %.2g +- %.1g", PM_REFINE_TRIES, last->error, last->uncertain);
	return 0;
}
