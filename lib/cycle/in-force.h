/* The sentence that cycle runs: the one typed, the one planned for the first frame, or with --again one that gives way to another between two steps.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CYCLE_IN_FORCE_H
#define PM_CYCLE_IN_FORCE_H

#include "cycle/plan-again.h"
#include "sentence/sentence.h"

struct pm_in_force {
	const struct pm_loop *c;
	struct pm_stage *s;
	struct pm_sentence *words; /* NULL: none yet */
	struct pm_replan again;    /* --again; every 0: the sentence stays */
};

int pm_in_force_speak(struct pm_in_force *y, const char *sentence); /* the sentence, made into stages */
/* --plan: the sentence chosen for the first frame, recorded in the history as if typed; a resumed run uses the one recorded there. */
int pm_in_force_plan(struct pm_in_force *y, struct pm_frame *f);
/* Between two steps: --again decides where that is due, and the frame is made ready for another sentence. */
int pm_in_force_again(struct pm_in_force *y, struct pm_frame **f);
int pm_in_force_finish(struct pm_in_force *y); /* the words have done their work; tells how their processes ended */
double pm_in_force_end(const struct pm_in_force *y, const struct pm_frame *f); /* the time at which the run will end; NAN: unknown */
json_t *pm_cycle_report(struct pm_frame *f); /* the entry "cycle" in the report of a frame */

#endif
