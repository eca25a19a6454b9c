/* Rates of change given by expressions, rate += expression: what field does. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EXPRESSION_GIVEN_RATES_H
#define PM_EXPRESSION_GIVEN_RATES_H

#include "expression/expression-jobs.h"

struct pm_given_rate_choice {
	const char *set;  /* this set alone; NULL: every set with the state whose rate is given */
	const char *term; /* the name under which it is added */
	bool replace;     /* computed anew instead of refused a second time */
};

/* Is "RATE = EXPRESSION" a rate of change: acc (of v), vel (of x), or d and the name of a state? 0 or failure. */
int pm_given_rate_check(const char *text);
/* Header: the rate on every set that it moves. 0 or failure. */
int pm_given_rate_declare(struct pm_expression_jobs *jobs, const struct pm_given_rate_choice *c, struct pm_frame *f, const char *text);
/* Data. */
int pm_given_rates_add(const struct pm_expression_jobs *jobs, const struct pm_frame *f);

#endif
