/* The state between the ends of the last step of an embedded pair, from the rates that push --dense has kept. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CYCLE_DENSE_OUTPUT_H
#define PM_CYCLE_DENSE_OUTPUT_H

#include "stream/frame.h"

/* Do all sets that move carry the rates of one whole step? The frame is between two steps. */
bool pm_dense_has(const struct pm_frame *f);
/* Drops these rates; what else a step needs stays. */
void pm_dense_leave_out(struct pm_frame *f);
/* A new frame at a time within the last step: the states that push advances, folded into a periodic box, without what was computed from them. Its step is
 * the number of steps completed before that time. NULL: failure with a message. */
struct pm_frame *pm_dense_frame(const struct pm_frame *f, double time);

#endif
