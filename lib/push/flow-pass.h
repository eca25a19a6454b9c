/* The pass over particles that move by a flow which m2p has left to be made: rates gathered, registers and positions advanced, a few at a time.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_FLOW_PASS_H
#define PM_PUSH_FLOW_PASS_H

#include "push/push-set.h"

/* declare(): says which fields need not be there. */
void pm_flow_declare(const struct pm_frame *f, struct pm_moving *m, const struct pm_push *p);
/* frame(): 1, all is done; 0, it must be done as always, and what it needs is there; or failure. h, crossed: those of pm_moving_run. */
int pm_flow_pass(const struct pm_frame *f, const struct pm_moving *m, const struct pm_advance *a, const double *h, double *crossed);

#endif
