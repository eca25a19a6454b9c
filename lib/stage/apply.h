/* Stages made from words and run on a frame in memory: for cycle, plan and the tests, which are linked with all words.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_APPLY_H
#define PM_STAGE_APPLY_H

#include "stage/stage.h"

struct pm_stage *pm_stage_new(const struct pm_tool *tool, int argc, char **argv); /* parsed and begun */
struct pm_stage *pm_stage_free(struct pm_stage *s);
int pm_stage_declare(struct pm_stage *s, struct pm_frame *f);  /* plan alone */
int pm_stage_apply(struct pm_stage *s, struct pm_frame *f); /* plan, ready, frame, settle; 0, PM_SKIP or failure */
extern const struct pm_tool *const pm_tools[] __attribute__((weak)); /* all of tools/, NULL ends; linked into cycle and the tests only */
const struct pm_tool *pm_tool_find(const char *name);

#endif
