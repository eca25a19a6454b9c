/* How far a run of cycle is: a line on the terminal that is rewritten in place, or with --verbose lines, less and less often.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CYCLE_PROGRESS_H
#define PM_CYCLE_PROGRESS_H

#include "stage/stage.h"

struct pm_progress {
	bool line, lines;           /* one in place; one after the other */
	int64_t first, here, steps; /* step at the beginning of the run, and of this process; steps of the run, INT64_MIN: not given */
	double to;                  /* [time] of the end; NAN: not given */
	double began, told, wrote;  /* clock: of the beginning, of what was printed last, of the frame written last */
	double pause;               /* [s] to the next of the lines */
	double rate, at;            /* [steps/s] of late; clock of the step `seen` */
	int64_t seen;
	double first_energy, energy; /* at the first step at which it could be computed; last; NAN: unknown */
	double measured, cost;       /* clock of that; [s] that it took */
};

void pm_progress_begin(struct pm_progress *p, const struct pm_stage *s, const struct pm_frame *f);
/* A pass is behind; called at every one, cheap where nothing is due. */
void pm_progress_step(struct pm_progress *p, const struct pm_frame *f);
void pm_progress_writes(struct pm_progress *p); /* a frame goes out: the next word may print a row on the same terminal */
void pm_progress_end(struct pm_progress *p, const struct pm_frame *f);

#endif
