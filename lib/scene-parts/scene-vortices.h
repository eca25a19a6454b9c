/* Shared by the vortex scenes: the plane under the law vortex, and a set of vortices that is a lattice on the nodes of the mesh (so that
 * the first p2m is exact) or a handful of points. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SCENE_VORTICES_H
#define PM_SCENE_VORTICES_H

#include "scene/scene.h"

enum { PM_SCENE_MARGIN = 4 }; /* nodes without vortices along an open face: the widest kernels reach 3 cells */

struct pm_scene_vortices { /* the arrays of the set, n values each */
	double *x[2], *circulation; /* [length], [length^2/time] */
};

/* The square lo..hi with the same face condition on every side, and the default mesh: the cells given by the user, else this number on each axis. */
int pm_scene_plane(const struct pm_scene_choice *c, struct pm_frame *f, double lo, double hi, enum pm_face face, size_t cells);
/* The set vortices: x, circulation, volume (of each) and id. */
int pm_scene_vortices(struct pm_frame *f, uint64_t n, double volume, struct pm_scene_vortices *v);
/* Shortens dt to what explicit diffusion on the mesh allows, if nu is above 0.
 * A vortex of circulation omega h_x h_y on every node of the mesh; none where |omega| <= least, nor in the margin along open faces. */
int pm_scene_vorticity(struct pm_frame *f, double (*omega)(const struct pm_scene_choice *c, double x, double y),
	const struct pm_scene_choice *c, double least);

#endif
