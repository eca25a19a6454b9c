/* The loop of cycle: full steps, output, checkpoints, interrupts. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CYCLE_LOOP_H
#define PM_CYCLE_LOOP_H

#include "stage/stage.h"

struct pm_loop { /* what the user asked for; the config of cycle */
	int64_t steps, every; /* INT64_MIN: not asked */
	double time;          /* NAN: not asked */
	const char *engine, *checkpoint, *resume, *until;
	struct pm_list moves;
	bool other_plans, plan; /* plan: the sentence that the first frame calls for */
	double accuracy;        /* of that */
};

/* Runs the sentence s->args[0] on every frame of the input. */
int pm_loop_run(struct pm_stage *s, const struct pm_loop *c);

#endif
