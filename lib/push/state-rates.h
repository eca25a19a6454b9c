/* Which state fields of a set push advances, and by which rates: x' = v, or vel for a set without v; v' = acc; any other state by the change field
 * that names it. Reads headers only. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_STATE_RATES_H
#define PM_PUSH_STATE_RATES_H

#include "step/step.h"
#include "stream/frame.h"

enum { PM_RATES = 16 };

struct pm_rate {
	struct pm_field *state, *rate;
	struct pm_field *q[PM_REGISTERS]; /* registers of a scheme; NULL outside */
};

int pm_rate_components(const struct pm_rate *r); /* that the rate and its state have in common */
bool pm_rate_is_state(const struct pm_field *field);
/* Refuses to advance a set by its change fields if there is a magnetic field (by: the scheme, which cannot use one; NULL: it can), or a
 * change on a mesh that was not interpolated to the particles. */
int pm_rates_allowed(const struct pm_frame *f, const struct pm_set *s, const char *by);
/* Every change field must belong to a state, or a contribution would be lost silently. */
int pm_rates_complete(const struct pm_frame *f, const struct pm_set *s);
/* The rates of a set, positions first: those that a kick, a drift or a scheme advances. Returns their number, or failure. */
int pm_rates(const struct pm_frame *f, const struct pm_set *s, enum pm_step_kind kind, struct pm_rate rates[PM_RATES]);

#endif
