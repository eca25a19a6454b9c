/* Steps of an error-controlled scheme (struct pm_control): all sets go through its nodes together, a pass each. After the last node one number over all sets
 * and threads decides: iterate again, take the step, or begin it anew with a shorter one. So this is known only with the data, and push holds the header.
 * What travels: dt is that of the step under way, between steps that of the next; a set's pass is the node its state is at; its "scheme" has the iteration,
 * the change that it made, the dt for which the series was foretold, and what rounding has left out of the time.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_STEP_CONTROL_H
#define PM_PUSH_STEP_CONTROL_H

#include "push/push-set.h"

/* What a pass has done. */
struct pm_controlled {
	bool completed, rejected; /* a step */
	bool unconverged;         /* it was completed after as many iterations as there may be */
	bool rounded;             /* its error is less than rounding lets see */
	bool least;               /* the next step would have been below the least one */
	uint64_t beyond;          /* particles of an implicit step whose solution is not known to go over into the start as dt falls */
	int iterations;           /* of a step that was completed or rejected */
	double dt, next;          /* [time] of that step; of the next */
	double error;             /* of that step: the last term of a rate over the rate */
};

/* Header, with the rates of a set known: refuses what the scheme cannot do, and fills m->pass. */
int pm_control_set(const struct pm_frame *f, struct pm_moving *m, const struct pm_push *p);
/* Has this rate a register with that number? A position beside a velocity has two, any other state all. */
bool pm_control_register(const struct pm_moving *m, const struct pm_rate *rate, int i);
/* Header, for all sets: they must be at one node, and none may be missing. A step is not begun longer than the longest. */
int pm_control_frame(struct pm_frame *f, size_t n, const struct pm_moving *moving, const struct pm_push *p);
/* Data, and the clock: of a scheme with a series, of an implicit one, of an embedded pair. */
int pm_implicit_run(struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_push *p, struct pm_controlled *done);
int pm_embedded_run(struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_push *p, struct pm_controlled *done);
int pm_control_run(struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_push *p, struct pm_controlled *done);

#endif
