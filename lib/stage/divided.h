/* A divided word on a divided frame: each rank runs frame() on its own stretch of every field in use (docs/distributed.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_DIVIDED_H
#define PM_DIVIDED_H

#include "stage/stage.h"

/* Rank 0, before declare(): the header, for the other ranks; free() it. NULL: the frame will not be divided (alone, or the word never is). */
char *pm_divided_header(const struct pm_stage *s, const struct pm_frame *f);
/* Behind declare(), which returned 0. */
bool pm_divided_can(const struct pm_stage *s, const struct pm_frame *f);
/* Behind that: checks the input, computes, settles. 0 or failure, agreed by all ranks. */
int pm_divided_apply(struct pm_stage *s, struct pm_frame *f, const char *header);
/* The other ranks, asked to: the same. tool: the word that this program is. */
int pm_divided_follow(const struct pm_tool *tool, const char *text);
void pm_divided_free(void);

#endif
