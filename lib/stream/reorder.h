/* The values of a set put into another order. What is left to be made (later.h) stays so where it can, of values in that order; what several have is put into
 * order once. Not where there are ranks. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_REORDER_H
#define PM_STREAM_REORDER_H

#include "stream/frame.h"

/* One of a set's particles, for all its fields: {.order = }, then free. */
struct pm_reorder {
	const size_t *order; /* value i becomes the old value order[i] */
	size_t known;
	struct pm_reorder_known {
		const void *was;
		void *now;
		struct pm_field *old, *made; /* of buffers, so that they stay */
	} *of;
};

/* Of a field with PM_USE_WAITS, in a frame that is not divided. 0 or failure. */
int pm_field_reorder(struct pm_field *field, struct pm_reorder *r);
/* For pm_later.reorder: a field held in that order (pm_held_free); NULL: failure. */
struct pm_field *pm_held_reorder(const struct pm_field *held, struct pm_reorder *r);
/* For the same: what was made before of `was`, which somebody else has too (NULL: nothing); and to say what now is. 0 or failure. */
void *pm_reorder_find(const struct pm_reorder *r, const void *was);
int pm_reorder_add(struct pm_reorder *r, const void *was, void *now);
void pm_reorder_free(struct pm_reorder *r);

#endif
