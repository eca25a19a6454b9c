/* The box that the user gives in place of a scene's own. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SCENE_BOX_H
#define PM_SCENE_BOX_H

#include "scene/scene.h"

/* Puts the box of c, if it has one, in place of what the scene has made. Refused where the scene would no longer be what it says: particles that fill a
 * periodic box, fields given on the mesh, also for other faces. 0 or failure. */
int pm_scene_box(const struct pm_scene *scene, const struct pm_scene_choice *c, struct pm_frame *f, bool other_faces);
int pm_scene_periods(const struct pm_frame *f); /* axes along which the fields are periodic */

#endif
