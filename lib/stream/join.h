/* Frames made from others: without a set or mesh, with fewer particles, several frames in one. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_JOIN_H
#define PM_STREAM_JOIN_H

#include "stream/frame.h"

/* Removes a set or mesh with its fields, if it exists. */
void pm_frame_remove(struct pm_frame *f, const char *name);
/* Keeps the particles where keep[i] is not 0; every field of the set must be loaded or uniform. In a divided frame
 * all ranks call it, keep is of the particles here, and they are divided anew. 0 or failure. */
int pm_frame_select(struct pm_frame *f, struct pm_set *set, const unsigned char *keep);

struct pm_join {
	bool merge;               /* sets of the same name become one; else the later is renamed NAME-2, NAME-3 ... */
	const char *const *names; /* of the sets of each frame, or NULL */
	int nnames;
	int64_t next_id;          /* the first id not yet used; updated */
	size_t frames;            /* joined so far; updated */
};

/* Adds the sets of b to a, whose box grows to include that of b; ids of b that may occur in a are increased. Both hold their data. Dimensions,
 * law, constants, time and faces must agree. Change, derived and register fields of both, and the meshes of b, are dropped. */
int pm_frame_join(struct pm_frame *a, const struct pm_frame *b, struct pm_join *join);
/* The same for the first frame: its meshes span the box again, its sets are renamed. */
int pm_frame_join_first(struct pm_frame *a, struct pm_join *join);

void pm_frame_meshes_span(struct pm_frame *f); /* every mesh spans the box again, its number of cells unchanged */

#endif
