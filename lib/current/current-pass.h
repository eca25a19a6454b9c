/* The current in one pass over the particles with what makes their velocities: gather of E and B, kicks, deposition. Private to lib/current.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CURRENT_PASS_H
#define PM_CURRENT_PASS_H

#include "current/current-frame.h"

/* In frame(), of a set whose velocities are left to be made: 1, they are there and the current is in mesh[3]; 0, not in one pass; or failure. */
int pm_current_pass(const struct pm_current_job *j, const struct pm_frame *f, const char *set, double *const mesh[3]);

#endif
