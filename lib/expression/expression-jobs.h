/* Fields and the expressions that compute them, from a stage's header to its data. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EXPRESSION_JOBS_H
#define PM_EXPRESSION_JOBS_H

#include "expression/expression.h"

struct pm_expression_job {
	struct pm_field *field;
	struct pm_expression e;
};

struct pm_expression_jobs { /* of the frame under way */
	struct pm_expression_job *job;
	size_t n, room;
};

/* Room for one more, which counts once n is raised; NULL with a message. */
struct pm_expression_job *pm_expression_jobs_next(struct pm_expression_jobs *jobs);
void pm_expression_jobs_free(struct pm_expression_jobs *jobs);

#endif
