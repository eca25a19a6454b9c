/* Effects: the physics and numerics that a frame may need. One file per effect has everything about it: the numbers that only it needs, whether leaving it
 * out would change the result by more than the accuracy, its words with their places in the sentence and their reasons, and how its decision is tested.
 * plan (lib/planner) measures the numbers that several effects share, calls every effect, and puts their words in order; the only effect it names is the
 * self field, which it measures. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EFFECT_H
#define PM_EFFECT_H

#include "base/base.h"

struct pm_frame;
struct pm_law;

/* The scales of a frame (lib/planner/scales.c). NAN: absent or unknown. */
struct pm_scales {
	int dim;
	const char *law;             /* its name */
	enum { PM_NO_FIELD, PM_CARRIED, PM_MASSES, PM_CHARGES, PM_VORTICES } kind; /* free, passive, gravity, plasmas, vortices */
	bool light;                  /* the fields evolve by Maxwell's equations: they are states of the mesh, and light is among them */
	bool second;                 /* second order in time: the particles have v and an acceleration */
	bool pairs;                  /* the far field is summed pair by pair, not on a mesh */
	bool singular;               /* vortices that do not fill their mesh: a field of points, not a vorticity that the mesh represents */
	bool periodic, open, walls;  /* some face is periodic, open, or (walls) of any other kind */
	double n, sources;           /* number of particles that move; of those with a strength, fixed ones included */
	double dt, time;             /* [time] the step, and the duration of the run */
	double h, box;               /* [length] largest spacing of the mesh, shortest side of the box */
	double points, edge;         /* number of mesh points; [length] smallest distance of a particle from an open face, HUGE_VAL: no such face */
	double softening, nu, c;     /* [length], [length^2/time], [length/time] constants of the frame; c NAN: infinite */
	double spread, nearest, spacing; /* [length] rms distance from the centre; of the nearest pair; mean distance of neighbours */
	double volume;               /* [length^dim] of the particles: the box if it is periodic, else the ball with their rms radius */
	double v_max, v_rms, v_thermal; /* [length/time] speeds, and the rms about the mean */
	double omega;                /* [1/time] collective frequency: omega_p, sqrt(4 pi G rho), largest vorticity */
	double encounter;            /* [1/time] of the nearest pair, softened: the fastest possible encounter */
	double orbit, eccentricity;  /* [1/time] mean motion of the orbit with the fastest pericentre, for few bodies; NAN: none */
	double few;                  /* bodies of all sets, fixed ones too, where there are few masses in 3-D (orbits.c); else NAN */
	double anomaly, stated;      /* [1] mean anomaly of that orbit now; the frequency that pp states at a distance, times the 1/omega of its circle */
	double pericentre;           /* [length] of that orbit */
	int components;              /* of v; of several sets the most */
	double debye;                /* [length] v/omega, v the rms of one component of v about its mean */
	double overlap, width;       /* mean |H - 1| of the particles, 0 for a lattice that represents a field; NAN: no volumes. [length] mean volume^(1/dim) */
	double ratio;                /* largest q/m */
	double courant;              /* [time] longest step of light on the mesh (maxwell --method yee); NAN: no light */
	double magnetic, wiggle;     /* c^2 B^2 over E^2 + c^2 B^2 + 2 kinetic/eps0, energies of the box; [1/length] sqrt(|lap B|/|B|) in l2, light alone */
	double given, cyclotron;     /* [length/time^2] largest (q/m) E given on a mesh; [1/time] largest (q/m) B */
	double self, self_max;       /* rms and largest contribution of the self field to acc [length/time^2] or vel [length/time] */
	double strain, rough;        /* [1/time] largest |grad u|; [1/length^2] |lap density|/|density| in l2 */
	double length;               /* [length] of the field: |field|/|its sources| in l2 */
	double mesh_error;           /* of the force on the mesh, by the atlas; NAN: not known */
	double accuracy;             /* of the user: relative changes below this are negligible */
	/* Of the particles as a sample (lib/planner/sampling.c), without a mesh. */
	double effective;            /* number of particles of equal strength with the same noise, (sum abs q)^2 / sum q^2 */
	double bodies;               /* how many real ones they stand for: the constant `bodies`, else n for masses, HUGE_VAL for charges */
	double thermal, drift;       /* [length/time] standard deviation of one component of v about the local flow of its beam; rms velocity of the beams */
	bool beams;                  /* two beams with thermal velocities well below their difference */
	double noise;                /* typical abs(a_k)^2, a_k = sum abs(q) exp(-i k x)/sum abs(q): 1/effective at random, less if quiet; NAN: no modes */
	double wave, wave_length;    /* of the modes above the noise: largest abs(a_k), 0: none; [length] field over sources, 1/k for one */
};

/* How the included effects are computed; plan chooses, effects may require more. */
struct pm_method {
	bool pairs, grow;      /* the far field pair by pair; the mesh follows particles that leave it */
	const char *kernel, *symbol, *order, *scheme; /* symbol NULL: the law's */
	bool conserving;       /* E and B of maxwell gathered with kernels one order lower (m2p --energy-conserving) */
	const char *kick;      /* half a kick: "kick/2", "boris/2" */
	size_t cells[3];       /* 0: those of the frame's mesh */
	double dt;             /* [time]; NAN: the frame's */
	double follow, until;  /* steps by dt --oscillation of this number, until this time; follow NAN: steps of one length */
	double tolerance;      /* of ias15, until this time too; NAN: another scheme */
	double evaluations;    /* of the force in the whole run; NAN: those of T/dt steps */
	char warning[400];     /* what the plan cannot promise; "" nothing */
	char why_far[160], why_mesh[160], why_step[160];
};

enum pm_answer { PM_LEFT_OUT, PM_PUT_IN };

struct pm_decision {
	enum pm_answer answer;
	bool error;      /* as `numerical` below, of an effect that is physics for other frames */
	bool kept;       /* included although it may be small: it has no cost, or nothing would move without it */
	double number;   /* the number that decided; NAN: none was needed */
	double share;    /* relative change caused by leaving it out, within the time of the run; NAN: unknown */
	int every;       /* interval in steps of an action that is not done in every step; 0 none */
	bool brought;    /* it is put in by the words of another effect */
	bool named;      /* its words do not do it for this frame: plan names it, and the result lacks it */
	char text[160];  /* the reason, with the number */
};

enum { PM_EFFECTS = 32, PM_EFFECT_OWN = 8, PM_EFFECT_WORDS = 32 };

/* The arguments of an effect's functions. */
struct pm_effect_case {
	const struct pm_frame *frame;
	const struct pm_law *law;
	const struct pm_scales *scales;
	const struct pm_method *method;
	const double *own;                       /* results of its measure; NAN before */
	const struct pm_decision *decision;      /* its own */
	struct pm_decision decided[PM_EFFECTS];  /* of all, in the order of pm_effects; PM_LEFT_OUT if an effect is needed but has no word */
};

/* Runs steps of the frame with the self field alone, for numbers that need the motion. */
struct pm_effect_run {
	struct pm_frame *(*steps)(const struct pm_effect_run *r, const struct pm_frame *f, int steps); /* a new frame; NULL with a message */
	struct pm_frame *(*force)(const struct pm_frame *f, const char *sentence); /* a new frame with what the words of a sentence do to its particles */
	const char *sentence;
};

/* The places of a sentence, in order. Within one the words stand in the order of pm_effects. */
enum pm_slot {
	PM_SLOT_OPENING,   /* push with the first half of the kick and the drift */
	PM_SLOT_SOURCE,    /* changes of the strengths before they are spread to the mesh */
	PM_SLOT_DENSITY,   /* particles to mesh */
	PM_SLOT_POTENTIAL, /* the potential of the density */
	PM_SLOT_FIELD,     /* the field of the potential */
	PM_SLOT_MESH,      /* other changes on the mesh, which the next word interpolates to the particles */
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

/* How plan --check tests the decision: with the effect and without, for a number of steps, and the quantity compared. */
struct pm_effect_test {
	enum { PM_TEST_MOTION, PM_TEST_WALK, PM_TEST_STRENGTH, PM_TEST_DENSITY } of; /* v or x; x of a walk, growing as sqrt(t); strengths; density */
	int steps;
};

struct pm_effect {
	const char *name, *sentence, *source;
	const char *word;  /* the word that computes it; NULL: the words of the self field, or the frame itself. Without `words`, plan can only name it */
	bool force;        /* it moves particles or rotates their velocities; if no such effect is included they move straight */
	bool replaces;     /* it replaces the particles, so other effects are tested without it */
	bool numerical;    /* an error of the method or the sample: put in if it exceeds the accuracy; then the result has it and plan says so */
	/* Do the frame's constants or fields ask for it? Then they are written to what ("nu = 0.01"), and cycle says so once where no word of its sentence does
	 * it: done_by, words or actions of push, or what is typed with a word, NULL ends. asked_beside: only of a sentence with one of these words; NULL: of
	 * every one. Headers alone. NULL: no. */
	bool (*asked)(const struct pm_frame *f, const struct pm_law *law, char what[64]);
	const char *const *done_by, *const *asked_beside;
	/* Measures numbers of the frame that only this effect needs, after scales and method are known. NULL: none. 0 or failure. */
	int (*measure)(const struct pm_effect_case *c, const struct pm_effect_run *run, double own[PM_EFFECT_OWN]);
	void (*decide)(const struct pm_effect_case *c, struct pm_decision *d);
	/* Revises its decision after all have decided. NULL: no revision. */
	void (*reconsider)(const struct pm_effect_case *c, struct pm_decision *d);
	/* The reason why the user cannot leave it out, with the remedy; "" if he can. NULL: he always can. */
	void (*stays)(const struct pm_effect_case *c, char why[160]);
	/* What its words need and the frame has not, so that the user cannot put it in. NULL: nothing, for any frame. */
	const char *(*lacks)(const struct pm_effect_case *c);
	/* The share with other scales of the mesh and another method: plan looks for one where it is small enough. NULL: nothing avoids it. */
	double (*share)(const struct pm_effect_case *c);
	/* Its requirements on the method, called whatever the decision. NULL: none. */
	void (*ask)(const struct pm_effect_case *c, struct pm_method *m);
	/* Adds its words, called whatever the decision. NULL: none yet, or none of its own. */
	void (*words)(const struct pm_effect_case *c, struct pm_words *w);
	/* Can the opposite decision also be written in words? Then plan --check tests it. NULL: no. */
	bool (*reversible)(const struct pm_effect_case *c);
	/* Other changes needed for that, of the frame and the method; in: it was left out and is now included. NULL: nothing. 0 or failure. */
	int (*reverse)(const struct pm_effect_case *c, bool in, struct pm_frame *f, struct pm_method *m);
	void (*test)(const struct pm_effect_case *c, struct pm_effect_test *t); /* NULL: the motion, after the default number of steps */
};

extern const struct pm_effect *const pm_effects[]; /* generated from lib/effect/, NULL ends */
extern const char *const pm_effect_names[];
const struct pm_effect *pm_effect_find(const char *name); /* NULL with a message */

#endif
