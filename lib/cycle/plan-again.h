/* cycle --plan --again K: the sentence is planned anew between steps, every K steps and when a number of the frame has changed much, by the frame and the
 * atlas alone. What is in force travels in the header attribute `plan`, so that a resumed run decides the same (docs/plan.md, Again during the run).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CYCLE_PLAN_AGAIN_H
#define PM_CYCLE_PLAN_AGAIN_H

#include "cycle/loop.h"
#include "planner/plan.h"

enum { PM_REPLAN_WHY = 1024 };

struct pm_replan_way { /* how the force and the step are made; what a decision compares */
	bool pairs, grow;
	char kernel[32], symbol[32], order[32], scheme[32]; /* symbol "": the law's */
	size_t cells[3];                                    /* of the mesh, whether typed or the frame's; 0: no mesh */
	int every[PM_EFFECTS];                              /* of pm_effects[i]: -1 left out, 0 put in, or the interval in steps */
};

struct pm_replan_seen { /* numbers that cost one pass over the particles and no force */
	double speed, rate, spread; /* largest |v|; mean of the change field, its largest of late; rms distance from the centre */
};

struct pm_replan_patience { /* with what could be given up */
	bool now, weak;    /* something could; the force is below half of what it was of late, so that its length scale says little */
	int64_t decisions; /* in a row in which something could */
	double dt;         /* shortest of the longer steps that they allowed; 0: none */
};

struct pm_replan {
	int64_t every, first, decided, since; /* steps: between decisions; of the first, the last decision, the last change. every 0: planned once */
	int64_t changes;
	double accuracy, began, end;          /* end NAN: unknown */
	double dt;                            /* [time] the step that the user gave, from which every decision starts */
	size_t cells[3];                      /* and the cells of the first mesh */
	struct pm_replan_way way;
	struct pm_replan_seen seen;           /* at the last decision */
	struct pm_replan_patience patience;
	char sentence[PM_PLAN_TEXT];
};

/* plan-again.c. The first decision of a run. 0 or failure. */
int pm_replan_begin(struct pm_replan *r, const struct pm_frame *f, FILE *warn); /* warn: as of pm_plan_sentence */
/* Is a decision due at this full step? */
bool pm_replan_due(const struct pm_replan *r, const struct pm_frame *f);
/* Decides. 1: r->sentence is another one, why tells what has changed; 0: it stays; or failure. Cost: as plan, twice where something would become cheaper. */
int pm_replan_decide(struct pm_replan *r, const struct pm_frame *f, char why[PM_REPLAN_WHY]);

/* plan-keep.c: the choice between what is in force and two plans: a, for the accuracy, and b, for a third of it (NULL: not made). a becomes the plan that
 * is carried out, its method.dt the length of the step. Is something changed? what: a list of the changes, with the reasons of the effects. dt: the step in
 * force; f: the frame that was planned for, with the user's step and mesh. Needed: is a cheaper in something than what is in force? */
bool pm_replan_needs_wary(const struct pm_replan_way *now, double dt, const struct pm_plan *a, const struct pm_frame *f);
bool pm_replan_keep(const struct pm_replan_way *now, double dt, struct pm_plan *a, const struct pm_plan *b, const struct pm_frame *f,
	struct pm_replan_patience *patience, char what[PM_REPLAN_WHY]);
void pm_replan_way_of(struct pm_replan_way *w, const struct pm_plan *p, const struct pm_frame *f);

/* plan-state.c: the attribute. Load fails where it is not one that cycle has written. */
void pm_replan_save(const struct pm_replan *r, struct pm_frame *f);
int pm_replan_load(struct pm_replan *r, const struct pm_frame *f);
/* The history: at the beginning the options of the run, which decide what comes, and the first sentence; later "from step S: SENTENCE" behind it. */
void pm_replan_entry(const struct pm_replan *r, json_t *entry, const struct pm_loop *c);
void pm_replan_record(const struct pm_replan *r, struct pm_frame *f);

/* plan-watch.c */
struct pm_replan_seen pm_replan_look(const struct pm_frame *f);
struct pm_replan_seen pm_replan_remember(const struct pm_replan_seen *before, const struct pm_frame *f);
bool pm_replan_weak(const struct pm_replan_seen *before, const struct pm_frame *f);
bool pm_replan_crossed(const struct pm_replan *r, const struct pm_frame *f);

#endif
