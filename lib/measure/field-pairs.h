/* Pairs of fields to compare in two frames. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_FIELD_PAIRS_H
#define PM_MEASURE_FIELD_PAIRS_H

#include "stream/frame.h"

enum { PM_FIELD_PAIRS = 256 };

struct pm_field_pairs_choice {
	const char *const *fields, *const *on; /* names, NULL ends; an empty list: all */
	bool common;                           /* skip fields that only one frame has */
	bool by_index;                         /* do not match particles by id */
};

struct pm_field_pairs {
	struct pm_field *a[PM_FIELD_PAIRS], *b[PM_FIELD_PAIRS];
	int n;
};

/* Pairs the fields, marks them and the ids as read; fails if two fields have different shapes. */
int pm_field_pairs_of(const struct pm_field_pairs_choice *c, struct pm_frame *f, struct pm_frame *g, struct pm_field_pairs *p);
/* Are the particles of this set matched by id? */
bool pm_field_pairs_by_id(const struct pm_field_pairs_choice *c, const struct pm_frame *f, const struct pm_frame *g, const char *on);
/* The weight in a mean of every point of a mesh field that is here: points on faces have half weight. pm_free it; NULL without memory. */
double *pm_field_pairs_weights(const struct pm_frame *f, const struct pm_field *field);

#endif
