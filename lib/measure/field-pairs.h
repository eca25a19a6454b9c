/* Which fields of two frames are compared with which. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_FIELD_PAIRS_H
#define PM_MEASURE_FIELD_PAIRS_H

#include "stream/frame.h"

enum { PM_FIELD_PAIRS = 256 };

struct pm_field_pairs_choice {
	const char *const *fields, *const *on; /* names, NULL ends; an empty list: all */
	bool common;                           /* fields of one frame only are passed over */
	bool by_index;                         /* never match by id */
};

struct pm_field_pairs {
	struct pm_field *a[PM_FIELD_PAIRS], *b[PM_FIELD_PAIRS];
	int n;
};

/* Pairs the fields, marks them and the ids as read, and refuses what has another shape. */
int pm_field_pairs_of(const struct pm_field_pairs_choice *c, struct pm_frame *f, struct pm_frame *g, struct pm_field_pairs *p);
/* Are the particles of this set matched by id? */
bool pm_field_pairs_by_id(const struct pm_field_pairs_choice *c, const struct pm_frame *f, const struct pm_frame *g, const char *on);
/* The weight of every point of a mesh in a mean: points on faces count half. pm_free it; NULL without memory. */
double *pm_field_pairs_weights(const struct pm_frame *f, const struct pm_mesh *m);

#endif
