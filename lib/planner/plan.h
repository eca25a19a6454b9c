/* Plans: the sentence for a frame, word by word with reasons; its cost; and a test that no effect was left out or included wrongly.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PLANNER_PLAN_H
#define PM_PLANNER_PLAN_H

#include "effect/effect.h"
#include "law/law.h"
#include "stage/stage.h"

enum { PM_PLAN_WORDS = PM_EFFECT_WORDS, PM_PLAN_TEXT = 2048, PM_PLAN_BLOCKS = 16 };

struct pm_plan_choice { /* the options of the user */
	double accuracy, time;  /* [time] end of the run; NAN: after a hundred steps of the frame */
	struct pm_list on, off; /* effects decided by hand */
	double within;          /* [s] of the run: far dearer plans are not timed; 0: any */
	bool cost;              /* measure seconds */
	bool untested;          /* chaos is not tested by runs: the plan is one of many of a run, the first of which was */
	const char *force;      /* the words of a force on a mesh, to decide on an effect beside them (pm_plan_decide); NULL or "": those of the plan */
};

struct pm_plan_word {
	char words[160], reason[320];
	double seconds; /* of a step; NAN: not measured */
};

struct pm_plan_effect {
	const struct pm_effect *effect;
	struct pm_decision decision;
	bool by_hand, lacking; /* lacking: needed, but there is no word for it yet */
	double own[PM_EFFECT_OWN]; /* the results of its measure */
	double saves, noise;   /* seconds per step saved by leaving it out, and what of that may be noise; NAN: not measured */
};

/* Of the whole run, until the time of the scales; NAN: not measured. */
struct pm_plan_cost {
	double steps;           /* of the run */
	double step, low, high; /* [s] of a step: the median of the blocks timed, the quickest, the value that nine tenths of them do not exceed */
	double begin;           /* [s] what the first step took longer: set-up, and the force before it */
	double processor;       /* [s] of all processors in a step */
	double load;            /* wall time over the processor time of the thread that leads: above 1, it waited for others */
	double memory, written; /* [bytes] held at most; fields of a frame that cycle writes */
	int timed;              /* steps */
	bool varies;            /* the sentence chooses its steps itself, and their number is that at the speed of the steps timed */
};

/* Steps timed in blocks of equal length; seconds are those of one step. */
struct pm_plan_timing {
	int blocks, steps, timed; /* steps done, and those in the blocks */
	double wall[PM_PLAN_BLOCKS], word[PM_PLAN_BLOCKS][PM_PLAN_WORDS];
	double first;           /* [s] of the first step, with set-up and the force before it */
	double processor, load; /* the means of all blocks, as above */
	double peak;            /* [bytes] held at most by the process */
};

struct pm_plan {
	const struct pm_law *law;
	struct pm_scales scales;
	struct pm_method method;
	int neffects, nstages;
	struct pm_plan_effect effect[PM_EFFECTS];
	struct pm_plan_word stage[PM_PLAN_WORDS];
	char sentence[PM_PLAN_TEXT];
	double force; /* seconds for the force of the frame */
	struct pm_plan_cost cost;
	char refused[300];  /* rounding and chaos forbid the accuracy; "": they do not, or it was not tested */
	char unproved[200]; /* and why not; "" */
	double within, next; /* [s] the time that the run may take, 0: any; the coarsest accuracy found not to be had, NAN: none */
	bool forbidden;      /* by chaos or rounding, not by the time */
};

/* For a frame with all its data in memory. 0 or failure. */
int pm_plan_frame(const struct pm_frame *f, const struct pm_plan_choice *c, struct pm_plan *p);
/* The decision on one effect. Cost: a force, and what the effect measures. 0 or failure. */
int pm_plan_decide(const struct pm_frame *f, const struct pm_effect *effect, const struct pm_plan_choice *c, struct pm_decision *d);
/* The sentence alone; and the one that cycle recorded in the history of a checkpoint. */
/* warn, if not NULL: there what the result will lack or have wrong is said. */
int pm_plan_sentence(const struct pm_frame *f, double accuracy, double end, char sentence[PM_PLAN_TEXT], FILE *warn);
int pm_plan_again(const struct pm_frame *f, char sentence[PM_PLAN_TEXT]);

/* plan-compose.c: the arguments of effect i; */
void pm_plan_case(const struct pm_frame *f, const struct pm_plan *p, int i, struct pm_effect_case *c);
/* is any effect included that moves particles? */
bool pm_plan_forced(const struct pm_plan *p);
/* plan-method.c: are the particles the nodes of the mesh, which cannot be refined without them? */
bool pm_plan_nodes(const struct pm_plan *p);
/* Stages and sentence from the decisions and the method. */
int pm_plan_compose(const struct pm_frame *f, struct pm_plan *p);
/* plan-method.c: pairs or a mesh, before the force is known; then kernel, gradient and cells. plan-step.c: scheme and step. */
void pm_plan_method(const struct pm_frame *f, struct pm_plan *p);
void pm_plan_mesh(const struct pm_frame *f, struct pm_plan *p);
double pm_plan_force_seconds(const struct pm_scales *s); /* of one core, for a force by this method */
double pm_plan_cost_mesh(const struct pm_scales *s); /* [ns] of a step on a mesh */
void pm_plan_cure(const struct pm_frame *f, struct pm_plan *p); /* plan-cure.c: more cells where an error of the method is too large */
void pm_plan_few_bodies(const struct pm_frame *f, struct pm_plan *p); /* before the force: their mesh follows from the nearest pair */
int pm_plan_step(const struct pm_frame *f, struct pm_plan *p);
/* orbit-scheme.c: of a pair, by the atlas: true if it was measured there. */
bool pm_plan_orbit(const struct pm_frame *f, struct pm_plan *p);
/* May ias15 advance this frame (lib/push/control-declare.c)? Its first step is the frame's. */
bool pm_plan_smooth(const struct pm_frame *f);
/* orbit-trial.c: of few bodies that the atlas does not hold, by trials with the frame itself. 0 or failure. */
int pm_plan_trial(const struct pm_frame *f, struct pm_plan *p);

/* plan-within.c: the most accurate plan within the seconds of the choice, whose accuracy is not used; and such a time as text. */
int pm_plan_within(const struct pm_frame *f, const struct pm_plan_choice *c, struct pm_plan *p);
int pm_plan_budget(const char *text, double *seconds);

/* plan-cost.c: what the run costs, from steps timed; */
int pm_plan_price(const struct pm_frame *f, struct pm_plan *p);
bool pm_plan_too_dear(const struct pm_frame *f, struct pm_plan *p, double seconds); /* ten times over these by the atlas, which it then puts into the cost */
double pm_plan_steps(const struct pm_frame *f, const struct pm_plan *p); /* of the run */
double pm_plan_seconds(const struct pm_plan *p);                         /* of the run, after _price */
int pm_plan_period(const struct pm_plan *p); /* the number of steps after which all that is not done in every step has been done */
double pm_plan_word_seconds(const struct pm_plan_timing *t, int word);
/* The seconds that a step of another sentence takes more than one of the plan, and what of that may be noise. */
double pm_plan_dearer(const struct pm_plan *p, const struct pm_plan_timing *t, double *noise);
const char *pm_plan_duration(double seconds, char text[32]);
void pm_plan_print_cost(FILE *out, const struct pm_plan *p);
json_t *pm_plan_cost_json(const struct pm_plan *p);

/* plan-run.c: runs a sentence for a number of full steps on a copy of a frame. */
struct pm_frame *pm_plan_run(const struct pm_frame *f, const char *sentence, int steps);
/* The same for as many steps as it takes to know their seconds, in blocks of a multiple of `period` steps; at most `most` steps if that is a block or more. */
struct pm_frame *pm_plan_time(const struct pm_frame *f, const char *sentence, int period, double most, struct pm_plan_timing *t);
/* Until this time, or until so many passes of the sentence are used up (one evaluation of the force each), which are counted down. */
struct pm_frame *pm_plan_run_until(const struct pm_frame *f, const char *sentence, double time, size_t *passes);
/* Runs the words that make fields from state, once. */
struct pm_frame *pm_plan_prime(const struct pm_frame *f, const char *sentence);
struct pm_frame *pm_plan_force(const struct pm_frame *f, const char *sentence); /* without the fields on meshes: these are large */
struct pm_frame *pm_plan_bare(const struct pm_frame *f); /* a copy without change and derived fields */

/* plan-check.c: tests every effect that can be left out or included, for a number of steps. */
struct pm_plan_proof {
	bool tried;        /* the reversed decision could be expressed */
	double difference; /* relative, for a run of scales.time */
	const char *of;    /* the quantity compared: "x", "v", "circulation", "omega" */
	const char *verdict;
	bool wrong;
};
int pm_plan_check(const struct pm_frame *f, const struct pm_plan *p, int steps, struct pm_plan_proof proof[PM_EFFECTS]);
/* The seconds saved by leaving out each effect, from a step with it; to be called after the stages were measured. */
int pm_plan_savings(const struct pm_frame *f, struct pm_plan *p);

/* plan-digits.c: a copy between steps whose state is moved by its last bit, up or down by the seed. */
struct pm_frame *pm_digits_moved(const struct pm_frame *f, uint64_t seed);
/* Writes refused, or unproved, where orbits may part within the run. 0 or failure. */
enum { PM_DIGITS_FEW = 64 };
int pm_plan_digits(const struct pm_frame *f, struct pm_plan *p);

/* plan-print.c */
void pm_plan_print(FILE *out, const struct pm_plan *p, bool cost);
/* A line for each effect that the sentence lacks, and for each error above the accuracy. */
void pm_plan_warn(const struct pm_plan *p, const char *tool, FILE *out);
void pm_plan_print_json(FILE *out, const struct pm_plan *p, bool cost);
void pm_plan_print_proof(FILE *out, const struct pm_plan *p, int steps, const struct pm_plan_proof *proof);

#endif
