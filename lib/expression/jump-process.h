/* Markov jump processes of particles: each particle has channels, each a rate and what it does to the particle's state. What jump does.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EXPRESSION_JUMP_PROCESS_H
#define PM_EXPRESSION_JUMP_PROCESS_H

#include "expression/expression-jobs.h"

enum { PM_JUMP_CHANNELS = 16, PM_JUMP_EFFECTS = 8 };

/* Of the frame under way; zero at first. */
struct pm_jump_process {
	struct pm_expression_jobs rates, effects; /* of a rate the field is NULL */
	struct pm_jump_channel {
		size_t rate, effect; /* the first of its effects */
		int effects;
	} *channel;              /* set by set: those of set i are channel[i * channels ...] */
	struct pm_jump_set {
		struct pm_set *set;
		uint64_t key;        /* of the random numbers */
	} *sets;
	size_t nsets;
	int channels;
};

/* Is it "RATE: NAME = EXPRESSION; NAME = EXPRESSION ..."? 0 or failure. */
int pm_jump_check(const char *text);
/* Header, only between two steps: the channels on `set`, or (NULL) on every set that has all states they change. What was derived from the state is dropped,
 * and can still be read by the channels. 0 or failure. */
int pm_jump_declare(struct pm_jump_process *p, struct pm_frame *f, const char *set, uint64_t seed, int channels, const char *const *text);
/* Data, all ranks: the jumps of one time step dt, from the state as it is. *jumps [of all ranks] is their number. 0 or failure. */
int pm_jump_step(const struct pm_jump_process *p, struct pm_frame *f, uint64_t *jumps);
void pm_jump_free(struct pm_jump_process *p);

#endif
