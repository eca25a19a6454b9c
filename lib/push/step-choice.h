/* The length of the next step by the error of this one, and the clock of steps that differ in length (push/embedded-run.c).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_STEP_CHOICE_H
#define PM_PUSH_STEP_CHOICE_H

#include "push/decided-step.h"

/* What a set's "scheme" holds of it between two passes. */
struct pm_choice {
	double error;  /* of the last step that was taken, over the tolerance; 0: none */
	bool rejected; /* the step under way was rejected before */
	double rest;   /* [time] left out of the frame's time by rounding */
};

struct pm_choice pm_choice_recall(const struct pm_moving *m, const struct pm_step *scheme);
/* With done->error known and order that of the member whose error it is: fills *done, sets dt where the step is rejected. Failure: no step is short enough. */
int pm_choice_of(struct pm_frame *f, const struct pm_push *p, int order, struct pm_choice *c, struct pm_controlled *done);
/* After a pass: remembers, and closes the clock; with done->completed the step is over, and dt is the next one. */
void pm_choice_take(struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_choice *c, int pass, double at, const struct pm_controlled *done);

#endif
