/* What all schemes share whose step ends where the data say so (pm_step_decides): their lines, their part of the header, and the end of a step.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_DECIDED_STEP_H
#define PM_PUSH_DECIDED_STEP_H

#include "push/step-control.h"

/* Every component of every state that these sets advance, as a row. */
struct pm_decided_line {
	const struct pm_moving *moving;
	struct pm_rate *rate;
	int c;          /* component */
	size_t n;       /* values here */
	double *y;      /* the state */
	const double *k;             /* its rate now */
	double *q[PM_REGISTERS];     /* its registers; NULL beyond those it has */
	double *x, *x_start;         /* x' = y: the position beside this velocity, and its register 0; NULL: none */
};

/* The lines of all sets; without positions beside a velocity if `paired` (these come with it). Their number; *lines is freed by the caller. Or failure. */
int pm_decided_lines(size_t n, struct pm_moving *moving, bool paired, struct pm_decided_line **lines);
/* Positions back into a periodic box. */
void pm_decided_fold(const struct pm_frame *f, size_t n, const struct pm_moving *moving);
/* A number that the scheme left in the header of its sets; 0 if it did not. */
double pm_decided_recall(const struct pm_moving *m, const char *key);
/* The pass is done: what the scheme remembers (with its name; all sets carry the same), and the clock. pass 0: the step is complete. */
void pm_decided_mark(struct pm_frame *f, size_t n, struct pm_moving *moving, json_t *memory, int pass, double at);
/* Drops the registers from this one on. */
void pm_decided_drop(struct pm_frame *f, size_t n, struct pm_moving *moving, int from);
double pm_decided_max(size_t n, const double *y); /* the largest |y| of those here */
/* n numbers, each the largest of a rank, to those of all ranks that share the state. */
void pm_decided_largest(const struct pm_field *state, size_t n, double *x);

#endif
