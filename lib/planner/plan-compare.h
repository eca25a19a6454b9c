/* A frame run by two sentences, and how far apart their results are. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PLANNER_PLAN_COMPARE_H
#define PM_PLANNER_PLAN_COMPARE_H

#include "planner/plan.h"

/* ---- runs: plan-run.c ---- */

struct pm_plan_span { /* of a run */
	struct pm_frame *half, *end;
	int64_t steps;
};
/* To time `to`, or for `most` steps if that comes first; half: the first frame at or after `middle`. 0 or failure. */
int pm_plan_run_span(const struct pm_frame *f, const char *sentence, double middle, double to, int64_t most, struct pm_plan_span *r);
void pm_plan_span_free(struct pm_plan_span *r);
struct pm_frame *pm_plan_pass(const struct pm_frame *f, const char *words); /* a copy behind words that select or change, once */

/* ---- differences: plan-compare.c ---- */

const char *pm_compare_what(const struct pm_frame *f, const struct pm_plan *p); /* the quantity that the accuracy is of */
/* |a - b| over the scale of b, in l2; NAN: they cannot be compared. a may have some of b's particles only. scaled: frames of the run of b, NULL none: the
 * scale of v is the largest of theirs. */
double pm_compare(const struct pm_frame *a, const struct pm_frame *b, const struct pm_frame *const scaled[3], const struct pm_plan *p, const char *of);

#endif
