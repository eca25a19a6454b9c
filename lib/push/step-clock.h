/* The clock of a step: the fraction of it that each set has done, the current pass of a scheme, and when the step is complete.
 * All of it is arithmetic on the header. Besides kick, drift and pass a set has, under the key "scheme", {name, dt, rates} of the
 * scheme that owns its registers (rates: the number of old steps in them), and "open": true after drift --open.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_STEP_CLOCK_H
#define PM_PUSH_STEP_CLOCK_H

#include "push/state-rates.h"

/* What a scheme does with one set in this pass. */
struct pm_pass {
	const struct pm_step *step; /* the scheme, or the one that starts it */
	int pass;                   /* of step */
	int registers;              /* in use: first those that the requested scheme keeps, then those of step */
	int known;                  /* kept registers that already have values */
	int kept;                   /* registers that remain after the pass */
	bool shift;                 /* the rate is stored in the kept registers */
};

bool pm_clock_complete(const struct pm_set *s);
void pm_register_name(char to[PM_NAME], int i, const char *state);
/* May a set be pushed at all: by a scheme (NULL: kicks and drifts), with this kick and drift? */
int pm_clock_allows(const struct pm_set *s, const struct pm_step *scheme, double kick, double drift);
/* Adds the fractions of one push to a set. */
int pm_clock_add(struct pm_set *s, double kick, double drift, bool open);
/* The next pass of a scheme on a set; advances the set's clock. */
int pm_clock_pass(const struct pm_frame *f, struct pm_set *s, const struct pm_step *asked, int n, const struct pm_rate *rates,
	struct pm_pass *p);
/* After a push: time is that of the slowest moving set; the step is complete when all sets have completed it. */
void pm_clock_close(struct pm_frame *f);

#endif
