/* Norms of the difference of two fields. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_NORMS_H
#define PM_MEASURE_NORMS_H

#include "stream/frame.h"

struct pm_norms {
	double l1, l2, max;                 /* mean |a-b|, root mean |a-b|^2, largest |a-b|; |.| is the length over the components */
	double relative_l2, relative_max;   /* the same divided by the norms of b; 0 if both are 0, infinite if only b is 0 */
	size_t worst;                       /* the first index at which |a-b| is largest, in the whole stream */
	int64_t worst_id;                   /* of the particle there; 0 without ids */
};

/* a and b have the same components and count; f has the set or mesh that a is on. match: value i of a is compared with value match[i] of b, NULL:
 * with i. weight: of value i in the means, NULL: 1. Exact zeros stay exact: equal fields give 0 in every norm. In a divided
 * frame all ranks call it, each with what is here, and get the norms of all. */
struct pm_norms pm_norms_of(const struct pm_frame *f, const struct pm_field *a, const struct pm_field *b, const size_t *match,
	const double *weight);
/* The same with the ids of particles, to name the worst; NULL: none. */
struct pm_norms pm_norms_with_ids(const struct pm_frame *f, const struct pm_field *a, const struct pm_field *b, const size_t *match,
	const double *weight, const int64_t *id);

/* match[i] is where b holds the id a[i]; order is workspace of n. 0, or failure that names an id which is missing or occurs twice. */
int pm_norms_match(size_t n, const int64_t *a, const int64_t *b, size_t *match, size_t *order);

#endif
