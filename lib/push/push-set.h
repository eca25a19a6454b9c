/* One set in one push: the fields it reads, changes, makes and drops (header), the run through the data, and absorption at the faces.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_SET_H
#define PM_PUSH_SET_H

#include "push/state-advance.h"
#include "push/step-clock.h"
#include "stream/strengths.h"

/* The actions of one push, the same for every set. */
struct pm_push {
	struct pm_advance actions;
	double part[PM_ADVANCE_ACTIONS]; /* of dt, for each action */
	double kick, drift;              /* sums of the parts */
	const struct pm_step *scheme;    /* NULL: kicks and drifts */
	const struct pm_step *magnetic;  /* the kick that turns v about bfield; NULL none */
	bool open, moves, unsafe;        /* a kick follows after the drift; positions change; any step length is allowed */
	double tolerance, floor, most;   /* of an error-controlled scheme: the error of a step, 0: steps of one length; its least and longest step [time] */
	bool dense;                      /* an embedded pair keeps its rates for states between the ends of a step */
	bool later;                      /* values may be left to be made, or are (kick-later.h, motion-pass.h, flow-pass.h) */
	bool clear;                      /* change and derived fields are dropped afterwards */
};

/* Adds one action as typed: clear, NAME or NAME/N. 0, or failure with a message. */
int pm_push_action(struct pm_push *p, const char *word);

struct pm_moving {
	struct pm_set *set;
	struct pm_field *x, *v; /* v NULL: none, or it is not changed */
	struct pm_field *b, *charge, *mass; /* of a magnetic kick; a relativistic one may have none */
	bool turned;            /* v is advanced by a magnetic kick */
	bool closing;           /* the drift is done */
	double part;            /* of a step that this push stands for where a rate limits it: 1, or less for a step split into parts */
	int n;
	struct pm_rate rates[PM_RATES];
	struct pm_pass pass;
};

bool pm_moving_face(const struct pm_frame *f, enum pm_particle_face face);
/* If particles may be absorbed, every field that is kept is rewritten, shorter. */
int pm_moving_shrinks(struct pm_frame *f, const struct pm_moving *m);
/* The mesh whose cells a push counts for the Courant number: the first that has a field, before the push drops it; NULL none. */
const struct pm_mesh *pm_push_mesh(const struct pm_frame *f);
/* Drops the change and derived fields of the meshes, of fixed sets and, with clear, of the sets themselves (only: of this one; NULL: of all). */
void pm_push_drops(struct pm_frame *f, const struct pm_push *p, const char *only);
/* The header part: refuses invalid pushes, advances the set's clock, declares the fields. */
int pm_moving_declare(struct pm_frame *f, struct pm_set *set, const struct pm_push *p, struct pm_moving *m);
/* The magnetic kick, NULL none: under a relativistic law boris advances gamma v. */
const struct pm_step *pm_moving_magnetic(const struct pm_frame *f, const struct pm_push *p);
/* With the tail: dt times the strain of the flow that moves the positions (stream/limits.h); 0 where none is known. */
double pm_moving_strain(const struct pm_frame *f, const struct pm_moving *m);
/* With the tail: refuses, unless unsafe, a step for whose rates the scheme, or a kick, is not stable. For schemes that are stable for no oscillation the limit
 * is where it doubles within its period. */
int pm_moving_stable(const struct pm_frame *f, const struct pm_moving *m, const struct pm_push *p);
/* The data part, without absorption. With the cells h [length per axis] of a mesh *crossed, at least its value before, is the Courant number of the
 * particles: the largest number of cells that one crosses in dt along an axis; h NULL: not wanted. */
int pm_moving_run(const struct pm_frame *f, const struct pm_moving *m, const struct pm_push *p, const double *h, double *crossed);
/* Removes the particles that have crossed an absorbing face; *absorbed is their number, lost the sums of their strengths. In a divided
 * frame all ranks call it, and what is left is cut anew. */
int pm_moving_absorb(struct pm_frame *f, const struct pm_moving *m, uint64_t *absorbed, struct pm_strengths *lost);
/* Sums of the strengths whose rates need not add up to 0: those that are given, and diffusion beside a face that strength passes. */
void pm_moving_given(const struct pm_frame *f, const struct pm_moving *m, struct pm_strengths *s);

#endif
