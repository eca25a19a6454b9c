/* The clock of a step: what part of it each set has done, which pass of which scheme is under way, and when the step is complete.
 * All of it is arithmetic on the header. Beside kick, drift and pass a set carries, under the key "scheme", {name, dt, rates} of the
 * scheme that owns its registers (rates: how many steps they remember), and "open": true after drift --open.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_STEP_CLOCK_H
#define PM_PUSH_STEP_CLOCK_H

#include "push/state-rates.h"

/* What a scheme does with one set in this pass. */
struct pm_pass {
	const struct pm_step *step; /* the scheme, or the one that starts it */
	int pass;                   /* of step */
	int registers;              /* in use: those the asked scheme keeps first, then those of step */
	int known;                  /* kept registers that are there already */
	int kept;                   /* registers that stay when the pass is done */
	bool shift;                 /* the rate enters the kept registers */
};

bool pm_clock_complete(const struct pm_set *s);
void pm_register_name(char to[PM_NAME], int i, const char *state);
/* Whether a set may be pushed at all: by a scheme (NULL: kicks and drifts), with this kick and drift. */
int pm_clock_allows(const struct pm_set *s, const struct pm_step *scheme, double kick, double drift);
/* Adds the fractions of one push to a set. */
int pm_clock_add(struct pm_set *s, double kick, double drift, bool open);
/* The next pass of a scheme on a set; moves the set's clock on. */
int pm_clock_pass(const struct pm_frame *f, struct pm_set *s, const struct pm_step *asked, int n, const struct pm_rate *rates,
	struct pm_pass *p);
/* After a push: time follows the slowest set that moves; when all have completed the step, it is done. */
void pm_clock_close(struct pm_frame *f);

#endif
