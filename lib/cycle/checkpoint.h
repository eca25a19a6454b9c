/* The checkpoint of cycle: a whole frame under a name of its own, replaced when the next one is whole, and locked by the cycle that writes it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CYCLE_CHECKPOINT_H
#define PM_CYCLE_CHECKPOINT_H

#include "stream/frame.h"

struct pm_checkpoint {
	const char *name; /* NULL: none is kept */
	int64_t steps;    /* between two of them; 0: not by steps */
	double seconds;   /* of wall time between them; 0: not by time. Both 0: with every frame that is written */
	double told;      /* clock of the last one, or of the beginning */
	int lock;         /* the file, open and locked; -1: none yet */
};

/* every: N steps, or a wall time as 30s, 10m, 2h; NULL: with every frame. Checks before anything is computed that the file can be written. 0 or failure. */
int pm_checkpoint_init(struct pm_checkpoint *c, const char *name, const char *every);
bool pm_checkpoint_with_frames(const struct pm_checkpoint *c);
/* Is one to be written at this full step? */
bool pm_checkpoint_due(const struct pm_checkpoint *c, const struct pm_frame *f);
int pm_checkpoint_write(struct pm_checkpoint *c, struct pm_frame *f); /* 0 or failure */
void pm_checkpoint_free(struct pm_checkpoint *c);

#endif
