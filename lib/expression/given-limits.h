/* The limits (stream/limits.h) of a rate of change given by an expression. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EXPRESSION_GIVEN_LIMITS_H
#define PM_EXPRESSION_GIVEN_LIMITS_H

#include "expression/expression-jobs.h"

/* Data: adds them to the job's field. All ranks; takes the status, and returns the agreed one. */
int pm_given_limits_add(int status, const struct pm_expression_job *job, const struct pm_frame *f);

#endif
