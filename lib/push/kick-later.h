/* Half a magnetic kick that is left to be made (stream/later.h), and the next half step's with it. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_KICK_LATER_H
#define PM_PUSH_KICK_LATER_H

#include "push/push-set.h"

/* declare(): may the kick be left? Then its rates and v need not be there. */
bool pm_kick_may_wait(const struct pm_moving *m, const struct pm_push *p);
/* frame(): leaves the kick of acc; 1, or 0: it must be made, and what it needs is there; or failure. */
int pm_kick_leave(const struct pm_frame *f, const struct pm_moving *m, const struct pm_step *step, struct pm_field *acc);

#endif
