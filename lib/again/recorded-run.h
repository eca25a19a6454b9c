/* The commands that the history of a file records, as lists of arguments for programs of ours: no shell parses any of it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_AGAIN_RECORDED_RUN_H
#define PM_AGAIN_RECORDED_RUN_H

#include <stdio.h>

#include "stream/wire.h"

enum { PM_RECORDED_MOST = 64, PM_RECORDED_ARGUMENTS = 256 };
struct pm_recorded_run {
	json_t *history;
	uint64_t frames;
	int64_t first, second, last; /* steps of these frames: how long cycle ran, and which frames it wrote, is in them alone */
	int n;
	char **argv[PM_RECORDED_MOST + 1]; /* NULL ends */
};

/* Reads the whole stream: it must be sound, and all its frames must have one history. */
int pm_recorded_read(struct pm_recorded_run *run, struct pm_reader *r);
/* The commands, from the last word on that makes a stream. Nothing is checked that is not needed to print them. */
int pm_recorded_commands(struct pm_recorded_run *run);
void pm_recorded_print(const struct pm_recorded_run *run, FILE *out, const char *before); /* a line that can be pasted into a shell */
/* Would they do what they did, and nothing else? Versions, words, options, input files, the sentences of cycle. */
int pm_recorded_check(const struct pm_recorded_run *run);
int pm_recorded_output(struct pm_recorded_run *run, const char *path); /* the last word writes there */
/* Runs them as processes joined by pipes; returns the end of the last pipe, or failure. */
int pm_recorded_start(const struct pm_recorded_run *run, int *end);
int pm_recorded_wait(const struct pm_recorded_run *run); /* 0, or the failure of the first word that failed */
void pm_recorded_free(struct pm_recorded_run *run);

#endif
