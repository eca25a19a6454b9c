/* cycle -t: at which step a run ends, and --exact, by which its last step is shorter. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CYCLE_RUN_END_H
#define PM_CYCLE_RUN_END_H

#include "sentence/sentence.h"

struct pm_run_end {
	double time; /* the end asked for; NAN: none */
	bool exact;
	double dt;   /* the step of the run while a shorter one is under way, else 0 */
	bool told;   /* the note was printed */
	bool chosen; /* a scheme chooses its steps, and may make the last one shorter still */
};

/* Fails if a word of the sentence sets dt itself, which --exact would have to. */
int pm_run_end_check(struct pm_run_end *e, const struct pm_sentence *s);
/* Has the run reached its end? At substep 0; time may run backwards. */
bool pm_run_end_reached(const struct pm_run_end *e, const struct pm_frame *f);
/* Before a step: makes it shorter if it would pass the end. After it: the time is exactly the end, and dt again that of the run. */
void pm_run_end_shorten(struct pm_run_end *e, struct pm_frame *f);
int pm_run_end_restore(struct pm_run_end *e, struct pm_frame *f);
/* A note, once, if the run has ended elsewhere than asked: by more than 1 % of its time, or at all with dt longer than that time
 * and with a scheme that chooses its steps. */
void pm_run_end_tell(struct pm_run_end *e, const struct pm_stage *cycle, const struct pm_sentence *s, const struct pm_frame *f, int64_t steps, double began);

#endif
