/* Shared by the scenes of vortices in space: box and mesh under the law vortex, and the set vortices, a lattice on the nodes of the mesh that carries a
 * vorticity, so that the first p2m is exact. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SCENE_SPACE_H
#define PM_SCENE_SPACE_H

#include "scene/scene.h"

/* The box lo..hi with the same face condition on every side, and the default mesh: the cells given by the user, else these. */
int pm_scene_space(const struct pm_scene_choice *c, struct pm_frame *f, const double lo[3], const double hi[3], enum pm_face face, const size_t cells[3]);
/* The set vortices: x, alpha = omega h_x h_y h_z, volume and id, one on every node of the mesh; none where |omega| <= least, nor within PM_SCENE_MARGIN nodes
 * of an open face. Shortens dt to what explicit diffusion on the mesh allows, if nu is above 0. */
int pm_scene_space_vorticity(struct pm_frame *f, void (*omega)(const struct pm_scene_choice *c, const double x[3], double w[3]),
	const struct pm_scene_choice *c, double least);

#endif
