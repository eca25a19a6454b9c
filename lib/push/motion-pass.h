/* A plain kick that is left to be made (stream/later.h), and the pass over the particles that makes it with the gather of its rates, the next kick and the
 * drift: `m2p | push kick/2`, and `push kick/2 drift` of the next step. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_MOTION_PASS_H
#define PM_PUSH_MOTION_PASS_H

#include "push/push-set.h"

/* declare(): says which fields need not be there. */
void pm_motion_declare(const struct pm_frame *f, struct pm_moving *m, const struct pm_push *p);
/* frame(): 1, the kick is left, or all is done in one pass; 0, it must be done as always, and what it needs is there; or failure. h, crossed: those of
 * pm_moving_run. */
int pm_motion_pass(const struct pm_frame *f, const struct pm_moving *m, const struct pm_advance *a, const double *h, double *crossed);

#endif
