/* One or two kicks, then a drift, of one axis in a periodic box: the loop that a step by a potential goes through (motion-pass.h). Beside the loops of
 * state-advance.h, which do any actions. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_KICK_DRIFT_H
#define PM_PUSH_KICK_DRIFT_H

#include "base/largest.h"
#include "push/state-advance.h"

enum { PM_KICK_DRIFT_AHEAD = 512 }; /* particles whose velocities are fetched before they are needed */

struct pm_kick_drift {
	int kicks; /* 1: kick[1] alone */
	double kick[2], drift; /* [time] */
};

/* Are the actions these? close: those of the kick that was left, or NULL. */
bool pm_kick_drift_is(const struct pm_advance *close, const struct pm_advance *open, struct pm_kick_drift *to);
/* Of the first of n particles, as many as fill whole vectors, whose number it returns: k [length/time^2], v, x. *most is raised to the bits of the largest |v|;
 * *finite stays true if all v and x are. */
size_t pm_kick_drift(size_t n, const struct pm_kick_drift *s, const struct pm_bounds *b, const double *k, double *v, double *x, int64_t *most, bool *finite);

#endif
