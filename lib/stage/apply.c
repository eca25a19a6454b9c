/* A stage applied to a frame in memory, by this rank or, where the word is divided, by all. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "stage/apply.h"
#include "stage/divided.h"
#include "stage/internal.h"
#include "stream/run.h"
#include "world/world.h"

/* The input of a stage must be finite; only fields that came from outside are checked, the others were checked when computed. */
static int check_input(struct pm_frame *f)
{
	for (size_t i = 0; i < f->nfields + f->ndropped; i++) {
		struct pm_field *p = i < f->nfields ? f->fields[i] : f->dropped[i - f->nfields];
		if (p->use & (PM_USE_READ | PM_USE_CHANGE) && !p->finite) {
			int status = pm_field_check(p, PM_DATA);
			if (status)
				return status;
		}
	}
	return 0;
}

/* The ranks share the work where the word can; else, and alone, it runs here. */
int pm_stage_apply(struct pm_stage *s, struct pm_frame *f)
{
	char *header = pm_divided_header(s, f);
	int plan = pm_stage_declare(s, f), status = plan < 0 || plan == PM_SKIP || plan == PM_PASS ? plan : 0;
	if (!status)
		status = pm_frame_affordable(f);
	const bool divided = !status && (!plan || plan == PM_HOLD) && header && pm_divided_can(s, f);
	s->frames[divided] += !status && pm_world_size() > 1;
	if (divided)
		status = pm_divided_apply(s, f, header);
	free(header);
	if (divided)
		return status;
	if (!status)
		status = check_input(f);
	if (!status)
		status = pm_frame_ready(f);
	if (!status && s->tool->frame)
		status = pm_stage_frame(s, f);
	if (status < 0 || status == PM_SKIP)
		return status;
	return pm_frame_settle(f);
}
