/* The watch of cycle over strengths: after every step the sum of each is compared with that at the beginning of the run. A change that the words have not
 * reported as permitted (stream/strengths.h) ends the run. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CYCLE_WATCH_H
#define PM_CYCLE_WATCH_H

#include "stream/strengths.h"

struct pm_watch {
	struct pm_strengths first;         /* at the beginning of the run */
	double permitted[PM_STRENGTHS];    /* what earlier runs had been permitted by then; of each name */
};

/* At the beginning of a run. */
void pm_watch_begin(struct pm_watch *w, const struct pm_frame *f);
/* After a step: 0, or -PM_NUMERICS with a message. Cost: one pass over the strengths. */
int pm_watch_step(const struct pm_watch *w, const struct pm_frame *f);
/* For a checkpoint, and back; saved NULL (a checkpoint of an older version): the run is watched from frame f on. */
json_t *pm_watch_save(const struct pm_watch *w);
void pm_watch_load(struct pm_watch *w, const struct pm_frame *f, const json_t *saved);

#endif
