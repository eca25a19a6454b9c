/* The runs of a trial while they are judged. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRIAL_RUNS_H
#define PM_TRIAL_RUNS_H

#include "trial/trial.h"

struct pm_alternative {
	const struct pm_choice *choice;
	struct pm_edit edit;
	struct pm_frame *frame;
	char from[48], to[48], sentence[PM_PLAN_TEXT];
	double steps; /* per step of the sentence */
	struct pm_plan_span run;
	bool ran;
};

struct pm_trials {
	const struct pm_frame *f;
	const struct pm_plan *p;
	struct pm_edit edit;
	char sentence[PM_PLAN_TEXT];
	double dt, middle, to;
	int64_t steps;
	struct pm_plan_span base;
	struct pm_alternative alt[PM_TRIAL_ROWS], again[PM_TRIAL_KINDS]; /* again: changed twice */
	int n;
};

enum { PM_TRIAL_LEAST = 4 }; /* steps of a trial */
static const double pm_trial_budget = 2.5e8; /* [ns] for all runs of one trial, estimated */

/* The sentence with one choice changed `times` times. 1: there is such an alternative; 0: none; failure. */
int pm_trial_alter(const struct pm_trials *t, const struct pm_choice *c, int times, struct pm_alternative *a);
bool pm_trial_ends(const struct pm_trials *t, struct pm_edit *e, char sentence[PM_PLAN_TEXT]); /* words that set dt themselves end their run at t->to */
void pm_trial_run_one(struct pm_trials *t, struct pm_alternative *a, struct pm_trial *r);
/* trial-judge.c: adds the row of an alternative that has run. Refinements first: the others are compared with their runs. */
void pm_trial_judge(struct pm_trials *t, struct pm_alternative *a, struct pm_trial *r);

#endif
