/* The loop of cycle: full steps, output, checkpoints, interrupts. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CYCLE_LOOP_H
#define PM_CYCLE_LOOP_H

#include "cycle/output.h"

struct pm_loop { /* the options; the config of cycle */
	int64_t steps, every, again; /* INT64_MIN: not given */
	double time;          /* NAN: not given */
	double interval;      /* [time] frames are written at its multiples; NAN: not given */
	const char *engine, *checkpoint, *checkpoint_every, *resume, *until;
	struct pm_output_choice output;
	struct pm_list moves;
	bool exact;           /* the last step is shorter where that is needed to end at time */
	bool other_plans, plan; /* plan: use the sentence that plan chooses for the first frame */
	double accuracy;        /* of that */
};

/* Runs the sentence s->args[0] on every frame of the input. */
int pm_loop_run(struct pm_stage *s, const struct pm_loop *c);

#endif
