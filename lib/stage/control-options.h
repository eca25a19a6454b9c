/* Options of push for an error-controlled scheme, and what such a step reports. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_CONTROL_OPTIONS_H
#define PM_STAGE_CONTROL_OPTIONS_H

#include "push/step-control.h"
#include "stage/stage.h"

/* Rows of options, for a struct config with the member `push` (struct pm_push). */
#define PM_CONTROL_ROWS \
	{.name = "tolerance", .kind = PM_REAL, .fallback = "1e-9", .low = 0, .high = 1, PM_AT(push.tolerance), \
		.text = "of ias15, rk45, rk23, and step doubling: the error of a step, relative (docs/methods/push.md says to what); 0: all steps are dt"}, \
	{.name = "min", .kind = PM_REAL, .unit = "time", .fallback = "0", .low = 0, .high = 1e300, PM_AT(push.floor), \
		.text = "likewise: the shortest step; those whose error needs a shorter one are counted as below_min"}, \
	{.name = "max", .kind = PM_REAL, .unit = "time", .fallback = "1e300", .low = 1e-300, .high = 1e300, PM_AT(push.most), \
		.text = "likewise: the longest step"}, \
	{.name = "dense", .kind = PM_FLAG, PM_AT(push.dense), \
		.text = "of rk45, rk23 and step doubling: keep the rates of a step, for frames at times within it (cycle --every-time)"}

/* Does this push choose its steps by their error? */
bool pm_control_chosen(const struct pm_push *p);
/* begin(): 0, or failure where an option stands beside a scheme that it does not belong to. */
int pm_control_begin(const struct pm_stage *s, const struct pm_push *p);
/* What this run of the word has done, for a line at its end. */
struct pm_control_tally {
	uint64_t steps, rejected, iterations;
	double shortest, longest; /* [time] of the steps, without their sign */
};

/* frame(): a pass, and its report; counts are added over the run. */
int pm_control_pass(struct pm_stage *s, struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_push *p, struct pm_control_tally *tally);
/* end(): a note, where there was more than a step; 0. */
int pm_control_end(const struct pm_stage *s, const struct pm_push *p, const struct pm_control_tally *tally);

#endif
