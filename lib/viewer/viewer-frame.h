/* A frame packed for a page. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_VIEWER_FRAME_H
#define PM_VIEWER_FRAME_H

#include "expression/expression.h"
#include "viewer/viewer-pack.h"

struct pm_viewer_choice {
	const char *set, *mesh, *field;     /* these alone; NULL all */
	const char *x, *y, *colour;         /* expressions over the particles; NULL none */
	size_t particles, points;           /* the most of a set and of a mesh */
};

struct pm_viewer_frame {
	json_t *head; /* what the page reads first: sets, meshes, fields, where their numbers are */
	struct pm_viewer_blocks blocks;
	size_t bytes;
	size_t thinned; /* every so many-th particle is left, of the set that is thinned most */
	size_t coarse;  /* the same along each axis of a mesh */
};

/* declare(): the fields that go onto the page. */
int pm_viewer_frame_reads(const struct pm_viewer_choice *c, struct pm_frame *f);
struct pm_viewer_frame *pm_viewer_frame_of(const struct pm_viewer_choice *c, struct pm_frame *f); /* NULL: failure */
struct pm_viewer_frame *pm_viewer_frame_free(struct pm_viewer_frame *p);

#endif
