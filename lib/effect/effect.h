/* Effects: what physics a frame may call for. One file per effect holds all that is known of it: the numbers that only it needs, whether leaving it out would
 * change the result by more than the accuracy asked for, its words with their places in the sentence and their reasons, and how its decision is tested.
 * plan (lib/planner) measures the numbers that several effects share, asks every effect, and puts their words in order; it knows none of them by name but the
 * self field, which it measures. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EFFECT_H
#define PM_EFFECT_H

#include "base/base.h"

struct pm_frame;
struct pm_law;

/* One frame in numbers (lib/planner/scales.c). NAN: not there, or not known. */
struct pm_scales {
	int dim;
	const char *law;             /* its name */
	enum { PM_NO_FIELD, PM_CARRIED, PM_MASSES, PM_CHARGES, PM_VORTICES } kind; /* free, passive, gravity, plasmas, vortices */
	bool second;                 /* moved by an acceleration: the particles have v */
	bool pairs;                  /* the far field is summed pair by pair, not on a mesh */
	bool periodic, open, walls;  /* a face of the fields is; walls: of any other kind */
	double n, sources;           /* particles that move; those with a strength, fixed ones too */
	double dt, time;             /* [time] the step, and how long the run is to last */
	double h, box;               /* [length] largest spacing of the mesh, shortest side of the box */
	double points, edge;         /* of the mesh; [length] of the particle nearest to an open face from it, HUGE_VAL: there is none */
	double softening, nu, c;     /* [length], [length^2/time], [length/time] constants of the frame; c NAN: infinite */
	double spread, nearest, spacing; /* [length] rms distance from the centre; of the nearest pair; of neighbours on the average */
	double volume;               /* [length^dim] of the particles: the box where it is periodic, else the ball with their rms radius */
	double v_max, v_rms, v_thermal; /* [length/time] speeds, and the rms about the mean */
	double omega;                /* [1/time] of the particles together: omega_p, sqrt(4 pi G rho), largest vorticity */
	double encounter;            /* [1/time] of the nearest pair, softened: the fastest thing there can be between two */
	double orbit, eccentricity;  /* [1/time] mean motion of the orbit with the fastest pericentre, where there are few bodies; NAN: none */
	double debye;                /* [length] v_thermal/omega */
	double overlap, width;       /* mean |H - 1| of the particles: 0 a lattice, they carry a field; NAN: no volumes. [length] mean volume^(1/dim) */
	double ratio;                /* largest q/m */
	double given, cyclotron;     /* [length/time^2] largest (q/m) E given on a mesh; [1/time] largest (q/m) B */
	double self, self_max;       /* rms and largest of what the self field adds to acc [length/time^2] or vel [length/time] */
	double strain, rough;        /* [1/time] largest |grad u|; [1/length^2] |lap density|/|density| in l2 */
	double length;               /* [length] of the field: |field|/|its sources| in l2 */
	double mesh_error;           /* of the force on the mesh, by the atlas; NAN: not known */
	double accuracy;             /* what is asked for: relative changes below are negligible */
};

/* How the effects that are put in are computed; plan chooses, effects may ask for more. */
struct pm_method {
	bool pairs, grow;      /* the far field pair by pair; the mesh follows particles that leave it */
	const char *kernel, *symbol, *order, *scheme; /* symbol NULL: the law's */
	const char *kick;      /* half a kick: "kick/2", "boris/2" */
	size_t cells[3];       /* 0: as the mesh of the frame */
	double dt;             /* [time]; NAN: the frame's */
	char why_far[160], why_mesh[160], why_step[160];
};

enum pm_answer { PM_LEFT_OUT, PM_PUT_IN };

struct pm_decision {
	enum pm_answer answer;
	bool kept;       /* put in though it may be small: it costs nothing, or nothing would move without it */
	double number;   /* the one that decided; NAN: none was needed */
	double share;    /* what leaving it out changes, relative, within the time of the run; NAN: not known */
	int every;       /* of what is not done in every step: steps between; 0 not asked */
	char text[160];  /* the reason, with the number */
};

enum { PM_EFFECTS = 32, PM_EFFECT_OWN = 8, PM_EFFECT_WORDS = 32 };

/* What an effect knows when it is asked. */
struct pm_effect_case {
	const struct pm_frame *frame;
	const struct pm_law *law;
	const struct pm_scales *scales;
	const struct pm_method *method;
	const double *own;                       /* what its measure found; NAN before */
	const struct pm_decision *decision;      /* its own */
	struct pm_decision decided[PM_EFFECTS];  /* of all, in the order of pm_effects; PM_LEFT_OUT where there is no word for what is needed */
};

/* Steps of the frame with the self field alone, for what shows only in motion. */
struct pm_effect_run {
	struct pm_frame *(*steps)(const struct pm_effect_run *r, const struct pm_frame *f, int steps); /* a new frame; NULL with a message */
	const char *sentence;
};

/* The places of a sentence, in order. Within one the words stand in the order of pm_effects. */
enum pm_slot {
	PM_SLOT_OPENING,   /* push, where half a kick and the drift come first */
	PM_SLOT_SOURCE,    /* changes of the strengths before they go to the mesh */
	PM_SLOT_DENSITY,   /* particles to mesh */
	PM_SLOT_POTENTIAL, /* the potential of the density */
	PM_SLOT_FIELD,     /* the field of the potential */
	PM_SLOT_MESH,      /* other changes on the mesh, which the next word takes to the particles */
	PM_SLOT_PARTICLES, /* mesh to particles, or a sum over pairs */
	PM_SLOT_FORCES,    /* other changes at the particles: given fields, friction */
	PM_SLOT_CLOSING,   /* push, which completes the step */
	PM_SLOT_AFTER,     /* after the step */
	PM_SLOTS
};

struct pm_word {
	enum pm_slot slot;
	char words[160], reason[320];
};

struct pm_words { /* written with pm_words_add and pm_words_amend (effect-parts/effect-words.h) */
	int n, amendments;
	struct pm_word word[PM_EFFECT_WORDS];
	struct pm_amendment {
		const char *word; /* of the slot */
		struct pm_word more;
	} amendment[PM_EFFECT_WORDS];
};

/* How plan --check tests the decision: with the effect and without, for so many steps, and what then differs. */
struct pm_effect_test {
	enum { PM_TEST_MOTION, PM_TEST_WALK, PM_TEST_STRENGTH, PM_TEST_DENSITY } of; /* v or x; x that goes on as the root of time; strengths; the density */
	int steps;
};

struct pm_effect {
	const char *name, *sentence, *source;
	const char *word;  /* the word that does it; NULL: those of the self field do, or it belongs to the frame. Without `words`, plan can only name it */
	bool force;        /* it moves particles or turns their velocities; where no such effect is in they go straight */
	bool replaces;     /* the particles are others after it, so other effects are tested without it */
	/* Numbers of the frame that no other effect needs, once scales and method are known. NULL: none. 0 or failure. */
	int (*measure)(const struct pm_effect_case *c, const struct pm_effect_run *run, double own[PM_EFFECT_OWN]);
	void (*decide)(const struct pm_effect_case *c, struct pm_decision *d);
	/* Its decision again, after all have decided. NULL: it stays. */
	void (*reconsider)(const struct pm_effect_case *c, struct pm_decision *d);
	/* Why it cannot be left out by hand, with the remedy; "" where it can. NULL: it always can. */
	void (*stays)(const struct pm_effect_case *c, char why[160]);
	/* What it wants of the method, whatever was decided about it. NULL: nothing. */
	void (*ask)(const struct pm_effect_case *c, struct pm_method *m);
	/* Its words, whatever was decided about it. NULL: none yet, or none of its own. */
	void (*words)(const struct pm_effect_case *c, struct pm_words *w);
	/* Can the other decision be said in words too? Then plan --check tests it. NULL: no. */
	bool (*reversible)(const struct pm_effect_case *c);
	/* What that takes besides other words: changes of the frame and the method; in: it was left out and is put in. NULL: nothing. 0 or failure. */
	int (*reverse)(const struct pm_effect_case *c, bool in, struct pm_frame *f, struct pm_method *m);
	void (*test)(const struct pm_effect_case *c, struct pm_effect_test *t); /* NULL: the motion, after the steps asked for */
};

extern const struct pm_effect *const pm_effects[]; /* generated from lib/effect/, NULL ends */
extern const char *const pm_effect_names[];
const struct pm_effect *pm_effect_find(const char *name); /* NULL with a message */

#endif
