/* Plans: the sentence that a frame calls for, word by word with its reason; what it costs; and the proof that no effect was left out or put in wrongly.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PLANNER_PLAN_H
#define PM_PLANNER_PLAN_H

#include "effect/effect.h"
#include "law/law.h"
#include "stage/stage.h"

enum { PM_PLAN_WORDS = PM_EFFECT_WORDS, PM_PLAN_TEXT = 2048 };

struct pm_plan_choice { /* what the user asked for */
	double accuracy, time;  /* [time] when the run is to end; NAN: after a hundred steps of the frame */
	struct pm_list on, off; /* effects decided by hand */
	bool cost;              /* measure seconds */
};

struct pm_plan_word {
	char words[160], reason[320];
	double seconds; /* of a step; NAN: not measured */
};

struct pm_plan_effect {
	const struct pm_effect *effect;
	struct pm_decision decision;
	bool by_hand, lacking; /* lacking: needed, and there is no word for it yet */
	double own[PM_EFFECT_OWN]; /* what its measure found */
	double saves;          /* seconds of a step that leaving it out saves; NAN: not measured */
};

struct pm_plan {
	const struct pm_law *law;
	struct pm_scales scales;
	struct pm_method method;
	int neffects, nstages;
	struct pm_plan_effect effect[PM_EFFECTS];
	struct pm_plan_word stage[PM_PLAN_WORDS];
	char sentence[PM_PLAN_TEXT];
	double force; /* seconds that the force of the frame took */
};

/* Of a frame whose data are all held. 0 or failure. */
int pm_plan_frame(const struct pm_frame *f, const struct pm_plan_choice *c, struct pm_plan *p);
/* The sentence alone; and the one that cycle left in the history of a checkpoint. */
int pm_plan_sentence(const struct pm_frame *f, double accuracy, double end, char sentence[PM_PLAN_TEXT]);
int pm_plan_again(const struct pm_frame *f, char sentence[PM_PLAN_TEXT]);

/* plan-compose.c: what effect i is asked with; */
void pm_plan_case(const struct pm_frame *f, const struct pm_plan *p, int i, struct pm_effect_case *c);
/* is any effect put in that moves particles; */
bool pm_plan_forced(const struct pm_plan *p);
/* stages and sentence from the decisions and the method. */
int pm_plan_compose(const struct pm_frame *f, struct pm_plan *p);
/* plan-method.c: pairs or a mesh, before the force is known; then kernel, gradient and cells. plan-step.c: scheme and step. */
void pm_plan_method(const struct pm_frame *f, struct pm_plan *p);
void pm_plan_mesh(const struct pm_frame *f, struct pm_plan *p);
void pm_plan_step(const struct pm_frame *f, struct pm_plan *p);

/* plan-run.c: runs a sentence for so many full steps on a copy of a frame. seconds, if not NULL: of each word in the last step, without set-up. */
struct pm_frame *pm_plan_run(const struct pm_frame *f, const char *sentence, int steps, double *seconds);
/* The words that make fields from state, once. */
struct pm_frame *pm_plan_prime(const struct pm_frame *f, const char *sentence);
struct pm_frame *pm_plan_bare(const struct pm_frame *f); /* a copy without change and derived fields */

/* plan-check.c: every effect that can be left out or put in, for so many steps. */
struct pm_plan_proof {
	bool tried;        /* it could be expressed */
	double difference; /* relative, of a run of scales.time */
	const char *of;    /* what differs: "x", "v", "circulation", "omega" */
	const char *verdict;
	bool wrong;
};
int pm_plan_check(const struct pm_frame *f, const struct pm_plan *p, int steps, struct pm_plan_proof proof[PM_EFFECTS]);
/* What leaving out each effect that could be put in saves, from a step with it; after the stages were measured. */
int pm_plan_savings(const struct pm_frame *f, struct pm_plan *p);

/* plan-print.c */
/* Runs the check and prints it; PM_NUMERICS where a decision was wrong. */
int pm_plan_prove(FILE *out, const struct pm_frame *f, const struct pm_plan *p, int steps);
void pm_plan_print(FILE *out, const struct pm_plan *p, bool cost);
void pm_plan_print_json(FILE *out, const struct pm_plan *p, bool cost);
void pm_plan_print_proof(FILE *out, const struct pm_plan *p, int steps, const struct pm_plan_proof *proof);

#endif
