/* Steps: how push advances state by its rates, independent of the law: x' = v (or vel), v' = acc, s' = its change field.
 * One file per action or scheme; the rest of push is in lib/push.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STEP_H
#define PM_STEP_H

#include "base/base.h"

enum { PM_STEP_PASSES = 12, PM_REGISTERS = 17 };

/* The registers of a state under an error-controlled scheme; the first PM_CONTROL_KEPT are kept from step to step. */
enum {
	PM_CONTROL_TERMS = 7,
	PM_CONTROL_REST = 0,
	PM_CONTROL_SERIES = 1,
	PM_CONTROL_FORETOLD = PM_CONTROL_SERIES + PM_CONTROL_TERMS,
	PM_CONTROL_KEPT = PM_CONTROL_FORETOLD + PM_CONTROL_TERMS,
	PM_CONTROL_START = PM_CONTROL_KEPT,
	PM_CONTROL_RATE
};

enum pm_step_kind {
	PM_KICK,  /* advances every state but the positions, and counts as kick */
	PM_DRIFT, /* advances the positions, and counts as drift */
	PM_SCHEME /* advances every state through a whole step, one pass of the sentence per force evaluation */
};

/* One set in a magnetic step; components that do not exist are NULL. */
struct pm_magnetic {
	double *v[3];                     /* [length/time] */
	const double *acc[3], *b[3];      /* [length/time^2] without v x B; [magnetic field] */
	const double *charge, *mass;
	bool alike;                       /* all charges and masses are the first */
	double c;                         /* [length/time] of relativistic kicks; b may then be absent */
	double radiation_time;            /* [time] of one that radiates: e^2/(6 pi eps0 m c^3) of a charge of |q/m| = 1 */
};

/* One component of a state under an error-controlled scheme, n values each. A position whose rate is this state (x beside v) goes with it. */
struct pm_control_line {
	double *y, *y_start;   /* the state, and what it was when the step began */
	double *y_rest;        /* what rounding has left out of y: y + y_rest is the state */
	double *x, *x_start, *x_rest;          /* x' = y; NULL: none */
	const double *k;                       /* the rate of y now */
	double *k_start;                       /* and at the beginning of the step */
	double *series[PM_CONTROL_TERMS];      /* of the rate over this step, as good as it is known */
	double *foretold[PM_CONTROL_TERMS];    /* what the step before said of them */
};

/* Maxima over the values of a state: of the rate, of the terms of its series, of the change of the last one in this iteration. */
struct pm_control_norms {
	double rate, change, term[PM_CONTROL_TERMS];
};

/* A scheme that iterates over the nodes of a step until its series has converged, and then takes the step or begins it again with a shorter one. */
struct pm_control {
	int nodes;               /* the first is the beginning of the step; a force evaluation each */
	const double *at;        /* their times, in units of dt */
	int most_iterations;
	double converged;        /* change over rate below which no further iteration is made */
	double rounding;         /* the most that rounding may add to the last term over the rate; above, a change that grows is no sign of it */
	double power;            /* last term over rate grows as this power of dt */
	double factor;           /* a step that should be shorter than this part of itself is rejected; none is longer than the last by more than 1/factor */
	/* At the beginning of a step; the series was foretold for dt/ratio. */
	void (*begin)(double ratio, size_t n, const struct pm_control_line *l);
	void (*correct)(int node, size_t n, const struct pm_control_line *l, struct pm_control_norms *norms); /* by the rate at this node; norms at the last */
	void (*place)(int node, double dt, size_t n, const struct pm_control_line *l);               /* puts the state there */
	/* Takes the step dt, and foretells the series of the next, dt times ratio; known: steps before that did so for this one. */
	void (*end)(double dt, double ratio, bool known, size_t n, const struct pm_control_line *l);
	void (*reject)(double ratio, size_t n, const struct pm_control_line *l); /* the series for dt times ratio, by what was foretold */
};

/* One implicit step: base = y + start dt k(y), then Y = base + part dt k(Y) is solved by iteration, and y + dt (...) = base + beyond (Y - base). */
struct pm_implicit {
	double start, part, beyond;
	double at; /* time of Y in units of dt */
};

enum { PM_IMPLICIT_DEPTH = 6, PM_IMPLICIT_REGISTERS = 3 + 2 * PM_IMPLICIT_DEPTH, PM_EMBEDDED_STAGES = 12 };

/* An embedded pair of Runge and Kutta: its last stage is at the end of the step, with the rate there. */
struct pm_embedded {
	int stages;
	int order;  /* of the lower member, by whose difference from the other a step is judged */
	double at[PM_EMBEDDED_STAGES];
	double a[PM_EMBEDDED_STAGES][PM_EMBEDDED_STAGES - 1]; /* the last row is the step itself */
	double error[PM_EMBEDDED_STAGES];                     /* difference of the members, over dt */
	double dense[PM_EMBEDDED_STAGES];                     /* the last term of the polynomial between the ends (embedded-run.c) */
};

struct pm_step {
	const char *name, *sentence, *source;
	enum pm_step_kind kind;
	int passes;    /* force evaluations per step; of an error-controlled scheme as many as it usually takes */
	int registers; /* per state, zero at the first pass, dropped after the last; each a linear combination of rates, so that it does not
	                * change when a particle is folded and changes sign when it is reflected */
	bool fills;    /* the first pass sets all registers without reading them */
	int rates;     /* old rates kept from step to step: q[0] of the last step, q[1] of the one before; push shifts them */
	bool changes;  /* what is kept is the change of the last step over dt instead, the last rate of the starting scheme; the pass keeps it itself */
	const char *start;  /* of schemes that keep rates: the one-step scheme for the first steps */
	int order;          /* of a whole step; of kick and drift: as kick/2 drift kick/2 */
	double real_limit;      /* largest |lambda| dt on the negative real axis; INFINITY: any; NAN: not made for decay; 0: none */
	double imaginary_limit; /* and on the imaginary axis */
	double doubling;        /* where that is 0: the |lambda| dt at which an oscillation doubles within its period */
	double at[PM_STEP_PASSES]; /* time of the state after each pass, in units of dt; compositions: by pm_step_at */
	/* Of a composition of kicks and drifts: each pass is a kick of this part of dt, then a drift of that; parts may be negative. NULL: no composition. */
	const double *kicks, *drifts;
	/* One pass over n values: y is advanced, k is its rate now, q the registers. NULL for compositions. */
	void (*pass)(int pass, double dt, size_t n, double *restrict y, const double *restrict k, double *const *q);
	/* For magnetic kicks, which rotate v about B: particles from..to-1, half a step of dt; every other state is kicked by pass. NULL: none. */
	bool relativistic; /* a magnetic kick that needs the constant c, and no magnetic field */
	bool radiates;     /* and the constant radiation_time, charge and mass */
	void (*magnetic)(bool closing, double dt, size_t from, size_t to, const struct pm_magnetic *m);
	const struct pm_control *control; /* of an error-controlled scheme, which has no pass; NULL */
	const struct pm_implicit *implicit; /* likewise; NULL */
	const struct pm_embedded *embedded; /* likewise; NULL */
};

extern const struct pm_step *const pm_steps[]; /* generated from lib/step/, NULL ends */
extern const char *const pm_step_names[];
const struct pm_step *pm_step_find(const char *name); /* NULL with a message */

/* Is it known only with the data whether a pass ends the step? */
static inline bool pm_step_decides(const struct pm_step *s) { return s->control || s->implicit || s->embedded; }
/* Does it choose its steps by their error? */
static inline bool pm_step_adapts(const struct pm_step *s) { return s->control || s->embedded; }

/* Time of the state after a pass, in units of dt; inside the step of a composition it may lie before its start or beyond its end. */
static inline double pm_step_at(const struct pm_step *s, int pass)
{
	double sum = 0;
	for (int i = 0; s->drifts && i <= pass; i++)
		sum += s->drifts[i];
	return pass + 1 == s->passes ? 1 : s->drifts ? sum : s->at[pass];
}

#endif
