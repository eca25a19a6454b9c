/* The part of a solver's report that does not depend on the solver. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "stage/solver-options.h"

const char *pm_solver_key(const struct pm_problem *p, const char *key, int c, char text[32])
{
	snprintf(text, 32, p->source->components > 1 ? "%s_%d" : "%s", key, c);
	return text;
}

void pm_solver_report_removed(const struct pm_stage *s, struct pm_frame *f, const struct pm_problem *p, int c, double mean, double incompatible)
{
	char key[32];
	pm_report(s, f, pm_solver_key(p, "mean_removed", c, key), mean);
	pm_report(s, f, pm_solver_key(p, "incompatible", c, key), incompatible);
	if (incompatible > 1e-12)
		pm_say(s, "no solution exists for this '%s' in this box: its mean %g, %.2g of its largest value, was removed", p->source_name, mean,
			incompatible);
}
