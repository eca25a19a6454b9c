/* A page: the frames of a stream in one HTML file with a script that shows them in a browser, without a server or a network (docs/methods/pictures.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_VIEWER_H
#define PM_VIEWER_H

#include "base/replace.h"
#include "expression/expression.h"
#include "viewer/viewer-frame.h"
#include "viewer/viewer-curves.h"

enum {
	PM_VIEWER_PARTICLES = 1000000, /* of a set in a frame; of more every k-th is on the page */
	PM_VIEWER_POINTS = 1 << 22,    /* of a mesh; of more every k-th along each axis */
	PM_VIEWER_BYTES = 200000000    /* of all frames; of more every second frame, fourth, ... is on the page */
};

struct pm_viewer { /* zero at first, but for what to show */
	/* what to show; NULL, 0, NAN: chosen by the page */
	const char *name;              /* the file; "-": standard output */
	const char *title, *map, *component;
	double fps, range[2], slice;
	int nrange, axis;
	bool log;
	struct pm_viewer_choice choice;
	size_t most;                   /* bytes of all frames; 0 (and of choice.particles, choice.points): the limits above */
	/* set by the functions */
	struct pm_replace file;
	uint64_t seen, stride;         /* frames seen; every stride-th of them is kept */
	size_t nkept, room, bytes;
	struct pm_viewer_frame **kept, *last; /* last: the last one seen, if it is not among the kept */
	struct pm_viewer_curves curves;
	json_t *history;               /* of the last frame */
	char scene[PM_NAME], law[PM_NAME];
};

int pm_viewer_reads(struct pm_viewer *v, struct pm_frame *f);     /* declare(): marks what is read */
int pm_viewer_add(struct pm_viewer *v, struct pm_frame *f);
int pm_viewer_end(struct pm_viewer *v);                           /* writes the file; nothing was written before */
/* A sentence on what is not on the page; "" all is. */
void pm_viewer_left_out(const struct pm_viewer *v, char text[320]);
void pm_viewer_drop(struct pm_viewer *v);

#endif
