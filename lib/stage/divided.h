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
/* Rank 0: source() of a word that is divided, on all ranks, whose frame has parts then. As source(): 1 and a frame, 0 no more, or failure. */
int pm_divided_source(struct pm_stage *s, struct pm_frame **f);
void pm_divided_source_follow(const struct pm_tool *tool, const char *text);

/* What all ranks did in the divided frames of a word, or (s NULL) sent in all. */
struct pm_tally {
	uint64_t bytes, messages;
	double slowest; /* seconds of work of the slowest rank over the mean; 1 where there are none */
};
/* Rank 0; own: what it did itself, in seconds and in bytes and messages sent. 0 or failure. */
int pm_divided_tally(const struct pm_stage *s, double seconds, const uint64_t sent[2], struct pm_tally *t);
void pm_divided_tally_follow(const struct pm_tool *tool, const char *text);

#endif
