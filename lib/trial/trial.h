/* What a sentence would give if it were computed otherwise: runs of a frame beside the sentence's own, each with one choice changed (half the step, twice
 * the mesh, ...), and from their differences the error of the result with its uncertainty. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRIAL_H
#define PM_TRIAL_H

#include "planner/plan-compare.h"
#include "planner/sentence-edit.h"

/* Choices of one kind govern the same error, of which the largest estimate counts; the kinds add up. */
enum pm_trial_kind { PM_TRIAL_TIME, PM_TRIAL_SPACE, PM_TRIAL_SAMPLING, PM_TRIAL_ROUNDING, PM_TRIAL_KINDS };
enum pm_trial_verdict { PM_TRIAL_PASS, PM_TRIAL_FAIL, PM_TRIAL_UNKNOWN };

enum { PM_TRIAL_ROWS = 16 };

/* ---- alternatives: choices-time.c, choices-space.c, choices-sample.c ---- */

struct pm_choice {
	const char *name;
	enum pm_trial_kind kind;
	/* A refinement by 2 whose error falls by a power: its differences extrapolate. The others are ways to compute the same thing: their difference is an
	 * error of the sentence where they are nearer to a refined run than the sentence is. */
	bool refines;
	/* Changes sentence and frame; from, to: for the reader. 0: there is none; 1: changed; failure. */
	int (*alter)(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48]);
};
extern const struct pm_choice pm_choices[]; /* name NULL ends; the first refines time, the second space */
enum { PM_CHOICE_STEP, PM_CHOICE_MESH, PM_CHOICE_COARSE };

/* ---- runs: trial.c ---- */

struct pm_trial_row {
	const struct pm_choice *choice;
	char from[48], to[48];
	double difference;       /* relative, measured; NAN: it cannot run */
	double error, uncertain; /* of the sentence by this choice, at the end of the run; NAN: this row says nothing about it */
	double order;            /* measured with a third run; NAN: that of the method was taken */
	char text[160];          /* in words */
};

struct pm_trial {
	struct pm_trial_row row[PM_TRIAL_ROWS];
	int n;
	char sentence[PM_PLAN_TEXT];
	const char *of;         /* the quantity: "x", "v", the density of vortices */
	int64_t steps, all;     /* of the sentence: tested, and of its run; 0: unknown, because dt sets them */
	double part;            /* of the run's time that was tested */
	double evaluations;     /* of forces, in all runs */
	double error, uncertain; /* at the end of the run, of all kinds */
	enum pm_trial_verdict verdict;
	int worst;              /* the row with the largest error; -1 none */
};

/* steps of the sentence: 0: as many as are affordable, at most the run. 0 or failure: the sentence itself cannot run. */
int pm_trial_of(const struct pm_frame *f, const struct pm_plan *p, const char *sentence, int64_t steps, struct pm_trial *t);

bool pm_trial_affordable(const struct pm_edit *e, const struct pm_frame *f, const struct pm_plan *p); /* a few steps of this sentence */

/* ---- trial-refine.c ---- */

/* Refines the choice that fails until the sentence passes, in at most PM_REFINE_TRIES trials; last: its final trial. why: "" or why there is none. */
enum { PM_REFINE_TRIES = 6 };
int pm_trial_refine(const struct pm_frame *f, const struct pm_plan *p, const struct pm_trial *first, struct pm_trial *last, char why[200]);

/* ---- trial-prove.c ---- */

/* Tests effects and choices, prints what it finds, and a sentence that passes where this one does not. PM_NUMERICS if a decision was wrong or the error
 * exceeds the accuracy. steps: 0 as many as are affordable; instead: a sentence to test instead of the plan's, NULL none. */
int pm_trial_prove(FILE *out, const struct pm_frame *f, const struct pm_plan *p, int64_t steps, const char *instead, bool json);

#endif
