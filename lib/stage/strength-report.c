/* Strengths that only one of the lists has are left out: a field or set was made or removed. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "stage/strength-report.h"

void pm_report_strengths(const struct pm_stage *s, struct pm_frame *f, const char *key, const struct pm_strengths *before,
	const struct pm_strengths *after)
{
	for (int i = 0; i < after->n; i++) {
		const struct pm_strength *now = &after->of[i], *then = before ? pm_strength_find(before, now->on, now->name) : NULL;
		char name[2 * PM_STRENGTH_NAME];
		snprintf(name, sizeof name, "%s_%s", key, now->name);
		if ((then || !before) && now->sum != (then ? then->sum : 0))
			pm_report_sum(s, f, name, now->sum - (then ? then->sum : 0));
	}
}
