/* A list of fields and expressions that grows. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "expression/expression-jobs.h"

struct pm_expression_job *pm_expression_jobs_next(struct pm_expression_jobs *jobs)
{
	if (jobs->n == jobs->room) {
		struct pm_expression_job *more = realloc(jobs->job, (2 * jobs->room + 4) * sizeof *more);
		if (!more) {
			pm_no_memory();
			return NULL;
		}
		jobs->job = more;
		jobs->room = 2 * jobs->room + 4;
	}
	return jobs->job + jobs->n;
}

void pm_expression_jobs_free(struct pm_expression_jobs *jobs)
{
	free(jobs->job);
	*jobs = (struct pm_expression_jobs){0};
}
