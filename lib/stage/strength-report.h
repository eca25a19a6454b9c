/* Reports of what a word does to the sums of strengths, for the account that cycle and diag read (stream/strengths.h): KEY_NAME, added over steps.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_STRENGTH_REPORT_H
#define PM_STAGE_STRENGTH_REPORT_H

#include "stage/stage.h"
#include "stream/strengths.h"

/* after - before of every strength of the list, where it is not 0; before NULL: 0. */
void pm_report_strengths(const struct pm_stage *s, struct pm_frame *f, const char *key, const struct pm_strengths *before,
	const struct pm_strengths *after);

#endif
