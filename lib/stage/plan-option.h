/* --plan of words with transforms: sentences of older streams and scripts have it. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_PLAN_OPTION_H
#define PM_STAGE_PLAN_OPTION_H

#include "stage/stage.h"

static const char *const pm_plan_choices[] = {"estimate", NULL};

#define PM_PLAN_ROW \
	{.name = "plan", .kind = PM_WORD, .choices = pm_plan_choices, PM_AT(plan), \
		.text = "accepted for older sentences and has no effect: FFTW's plans are always estimated"}

#endif
