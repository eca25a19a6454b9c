/* Numbers on a plane: a cut through a mesh, the sum along an axis, or the density of points. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PICTURE_RASTER_H
#define PM_PICTURE_RASTER_H

#include "stream/frame.h"

struct pm_raster {
	size_t n[2];        /* nodes */
	double lo[2], h[2]; /* of the nodes */
	bool wrap[2];       /* periodic: the node after the last is the first */
	double *value;      /* first axis fastest */
};

/* These two of a field that ranks share: all call, and rank 0 gets the values. */
/* The component (-1: length) of a mesh field on the plane `axis` = at, linear between the mesh planes. */
int pm_raster_slice(struct pm_raster *r, const struct pm_frame *f, const struct pm_mesh *m, const struct pm_field *field, int component, int axis, double at);
/* Its integral along the axis; points on a face count half. */
int pm_raster_project(struct pm_raster *r, const struct pm_frame *f, const struct pm_mesh *m, const struct pm_field *field, int component, int axis);
/* Points of weight w (NULL: 1) per area, spread linearly over bins[2] bins between lo and hi; *outside counts those left out. Of points that ranks share n are
 * here and `all` are on all ranks, which call, and get the raster of all. */
struct pm_raster_points {
	size_t n, all;
	const double *x, *y, *w;
	bool shared;
};
int pm_raster_density(struct pm_raster *r, const size_t bins[2], const double lo[2], const double hi[2], const struct pm_raster_points *points,
	size_t *outside);
/* One pass of the 1-2-1 filter along both axes; the sum is unchanged. */
int pm_raster_smooth(struct pm_raster *r);
/* Linear between the nodes, constant beyond the last. */
double pm_raster_at(const struct pm_raster *r, double x, double y);
void pm_raster_free(struct pm_raster *r);

#endif
