/* A stable order of a set that is divided over the ranks: the order of a run alone, because a stable order is unique. Every rank keeps as many particles as it
 * had. All ranks call these, in the same order; each takes the caller's status and returns the agreed one. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CELL_SORT_RANKS_H
#define PM_CELL_SORT_RANKS_H

#include "stream/frame.h"

struct pm_sort_ranks {
	size_t n;       /* particles here */
	size_t *leave;  /* n: leave[i] is the place here of the i-th by key, in the order of which particles leave */
	size_t *arrive; /* n: particle i will be number arrive[i] of those that arrive */
	size_t *out;    /* of every rank: how many go there */
	size_t *in;     /* of every rank: how many come from there */
};

/* key: those of the n particles here; from: the beginnings of all ranks' stretches, one more than ranks. */
int pm_sort_ranks_init(int status, const uint64_t *from, size_t n, const uint64_t *key, struct pm_sort_ranks *s);
int pm_sort_ranks_permute(int status, const struct pm_sort_ranks *s, struct pm_field *field);
/* The way back: values in the order of keys go to the particles as they were divided before. */
int pm_sort_ranks_return(int status, const struct pm_sort_ranks *s, struct pm_field *field);
void pm_sort_ranks_free(struct pm_sort_ranks *s);

#endif
