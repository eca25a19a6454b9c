/* Particles of two sets that are divided over the ranks, matched by id. All ranks call these, in the same order; each takes the caller's status and returns the
 * agreed one. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_MATCH_RANKS_H
#define PM_MEASURE_MATCH_RANKS_H

#include "cell/sort-ranks.h"

struct pm_match_ranks {
	bool same; /* both have the same ids in the same order, ascending: there is nothing to bring */
	struct pm_sort_ranks a, b;
};

/* ids: of both sets, which are equally divided. Failure as that of pm_norms_match; free in any case. */
int pm_match_ranks_init(int status, const struct pm_field *a, const struct pm_field *b, struct pm_match_ranks *m);
/* The values of a field of b in the order in which a has these particles: a field of its own (pm_field_copy_free), or NULL where both have the same order. */
int pm_match_ranks_bring(int status, const struct pm_match_ranks *m, const struct pm_field *b, struct pm_field **brought);
void pm_match_ranks_free(struct pm_match_ranks *m);

#endif
