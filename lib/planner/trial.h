/* What a sentence would give if it were computed otherwise: runs of a frame beside the sentence's own, each with one choice changed (half the step, twice
 * the mesh, ...), and from their differences the error of the result with its uncertainty. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PLANNER_TRIAL_H
#define PM_PLANNER_TRIAL_H

#include "planner/plan.h"
#include "planner/sentence-edit.h"

/* Choices of one kind govern the same error, of which the largest estimate counts; the kinds add up. */
enum pm_trial_kind { PM_TRIAL_TIME, PM_TRIAL_SPACE, PM_TRIAL_SAMPLING, PM_TRIAL_ROUNDING, PM_TRIAL_KINDS };
enum pm_trial_verdict { PM_TRIAL_PASS, PM_TRIAL_FAIL, PM_TRIAL_UNKNOWN };

enum { PM_TRIAL_ROWS = 16 };

/* ---- alternatives: plan-choices.c ---- */

struct pm_choice {
	const char *name;
	enum pm_trial_kind kind;
	/* A refinement by 2 whose error falls by a power: its differences extrapolate. The others are ways to compute the same thing: their difference is an
	 * error of the sentence where they are nearer to a refined run than the sentence is. */
	bool refines;
	/* Changes sentence and frame; from, to: for the reader. 0: there is none; 1: changed; failure. */
	int (*alter)(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48]);
	const char *remedy; /* of a scene, where no sentence refines it; NULL: a sentence can */
};
extern const struct pm_choice pm_choices[]; /* name NULL ends; the first refines time, the second space */
enum { PM_CHOICE_STEP, PM_CHOICE_MESH, PM_CHOICE_COARSE };

int pm_choice_order(const struct pm_edit *e);  /* of the scheme of its push: 1 if none is known */
int pm_choice_passes(const struct pm_edit *e); /* force evaluations per step */
double pm_choice_step(const struct pm_edit *e, const struct pm_frame *f); /* [time] of the sentence, or of the frame; NAN: the word dt sets it */
double pm_choice_points(const struct pm_edit *e, const struct pm_frame *f); /* of the mesh of p2m; 0: no p2m */
bool pm_choice_nodes(const struct pm_plan *p); /* the particles are the nodes of the mesh: it cannot be refined without them */

/* ---- runs: plan-trial.c ---- */

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

double pm_trial_cost(const struct pm_edit *e, const struct pm_frame *f, const struct pm_plan *p); /* [ns] of a step, estimated */
bool pm_trial_affordable(const struct pm_edit *e, const struct pm_frame *f, const struct pm_plan *p); /* a few steps of this sentence */

struct pm_trial_run {
	struct pm_frame *half, *end;
	int64_t steps;
};
/* To time `to`, or for `most` steps if that comes first; half: the first frame at or after `middle`. 0 or failure. */
int pm_trial_run(const struct pm_frame *f, const char *sentence, double middle, double to, int64_t most, struct pm_trial_run *r);
void pm_trial_run_free(struct pm_trial_run *r);
struct pm_frame *pm_trial_pass(const struct pm_frame *f, const char *words); /* a copy behind words that select or change, once */

/* ---- differences: plan-compare.c ---- */

const char *pm_compare_what(const struct pm_frame *f, const struct pm_plan *p); /* the quantity that the accuracy is of */
/* |a - b| over the scale of b, in l2; NAN: they cannot be compared. a may have some of b's particles only. scaled: frames of the run of b, NULL none: the
 * scale of v is the largest of theirs. */
double pm_compare(const struct pm_frame *a, const struct pm_frame *b, const struct pm_frame *const scaled[3], const struct pm_plan *p, const char *of);

/* ---- plan-refine.c ---- */

/* Refines the choice that fails until the sentence passes, in at most PM_REFINE_TRIES trials; last: its final trial. why: "" or why there is none. */
enum { PM_REFINE_TRIES = 6 };
int pm_refine(const struct pm_frame *f, const struct pm_plan *p, const struct pm_trial *first, struct pm_trial *last, char why[200]);

#endif
