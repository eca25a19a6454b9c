/* A level set on particles: what its scenes share. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SCENE_LEVEL_H
#define PM_SCENE_LEVEL_H

#include "scene/scene.h"

/* The periodic unit square under the law passive, the default mesh of these cells (or the user's), and a particle on each node: set matter with x,
 * volume and the value `level` of time 0, below 0 inside. The parameters of c are in f. */
int pm_scene_level(const struct pm_scene_choice *c, struct pm_frame *f, size_t cells,
	double (*level)(const struct pm_frame *f, const double x[], double t));

#endif
