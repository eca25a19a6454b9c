/* A view of a frame: which numbers, how scaled, as a plot (docs/methods/pictures.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PICTURE_VIEW_H
#define PM_PICTURE_VIEW_H

#include "expression/expression.h"
#include "picture/plot.h"

struct pm_view {
	/* the options; NULL, NAN and n = 0: chosen from the frame */
	const char *field, *mesh, *set, *x, *y, *colour, *weight, *title;
	int component;         /* of a mesh field, -1: the length of a vector */
	int axis;              /* normal of the slice, or direction of the projection, 0 to 2 */
	double slice;          /* [length] where; NAN: the middle of the box */
	bool project, points, density, log, linear;
	int map;               /* -1: viridis, inferno, or coolwarm for numbers of both signs */
	int nrange, nwindow;
	double range[2], window[4];
	int size;              /* pixels of the longer side of the data */
	/* set by pm_view_plan */
	bool on_mesh;
	char on[PM_NAME], drawn[PM_NAME];
	struct pm_expression ex, ey, ecolour, eweight;
};

int pm_view_component(const char *word); /* x, y, z or a number from 0; -1: none of these */
int pm_view_plan(struct pm_view *v, struct pm_frame *f);                    /* decides what to draw, and marks the fields to be read */
int pm_view_draw(struct pm_view *v, struct pm_frame *f, struct pm_plot *p); /* free the plot in any case */

#endif
