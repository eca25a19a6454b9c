/* What the two ways to solve an implicit step share: Y = base + part dt k(Y), its registers, and the iterate. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_IMPLICIT_STEP_H
#define PM_PUSH_IMPLICIT_STEP_H

#include "push/decided-step.h"

/* Registers of a line: the equation, and what a method keeps beside it. */
enum { PM_IMPLICIT_BASE, PM_IMPLICIT_TRIAL, PM_IMPLICIT_RESIDUAL, PM_IMPLICIT_OWN, PM_IMPLICIT_LINES = 192 };

struct pm_iterate {
	const struct pm_implicit *scheme;
	double dt;
	int number; /* of this iteration, from 1; a pass each */
	int lines;
	struct pm_decided_line *line;
	/* Of each line: the factor of a residual in the first guess; 1/scale^2, scale that of the state; what is small beside its largest value. */
	double damp[PM_IMPLICIT_LINES], weight[PM_IMPLICIT_LINES], small[PM_IMPLICIT_LINES];
};

/* The end of the lines that belong to the set of line `from`. */
static inline int pm_iterate_set(const struct pm_iterate *it, int from)
{
	int to = from;
	while (to < it->lines && it->line[to].moving == it->line[from].moving)
		to++;
	return to;
}

/* Anderson's iteration. Before the residual is renewed: the old one, of which the change is left in its column. Then: the next trial; own: each particle has
 * its own columns. */
void pm_anderson_residual(struct pm_iterate *it);
void pm_anderson_correct(struct pm_iterate *it, bool own);

/* Newton's method, of each particle alone. column: 0 at a trial, from 1: a value of every particle was changed for a difference. */
enum { PM_NEWTON_LINES = 10 }; /* of one set, the most it can do */
enum pm_newton { PM_NEWTON_SOLVED, PM_NEWTON_DIFFERENCES, PM_NEWTON_TRIAL };

bool pm_newton_can(const struct pm_iterate *it);
int pm_newton_columns(const struct pm_iterate *it); /* the most of any set: passes for one Jacobian */
/* At a trial, with its residual: is it solved, are differences wanted, or is there another trial? first: the trial is the state at the start. */
enum pm_newton pm_newton_judge(struct pm_iterate *it, bool first);
void pm_newton_difference(struct pm_iterate *it, int column);  /* takes the rates of a changed value */
void pm_newton_correct(struct pm_iterate *it);                 /* the next trial, when all differences are known */
double pm_newton_change(const struct pm_iterate *it, int line, size_t i); /* of value i of this line, for its difference */
uint64_t pm_newton_beyond(const struct pm_iterate *it); /* particles whose det(1 - part dt J) is negative */

#endif
