/* The parameters of all scenes as one list, each name once: what pinit offers as options.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SCENE_PARAMETERS_H
#define PM_SCENE_PARAMETERS_H

#include "scene/scene.h"

enum { PM_SCENE_ROWS = 128 }; /* at most; tests/unit/scene.c counts */

/* Index of a name in rows[0..n-1], n if it is not there. */
int pm_scene_row_at(const struct pm_scene_parameter *const *rows, int n, const char *name);
/* The first row of every name, in the order of the table; returns their number. */
int pm_scene_rows(const struct pm_scene_parameter *rows[PM_SCENE_ROWS]);
/* "text (default: plummer 0.02, uniform 0.001)": which scenes have a parameter, with their defaults. */
void pm_scene_row_text(const struct pm_scene_parameter *row, char *text, size_t bytes);
/* The parameters of a scene: typed[row of the list], NAN for the default. Parameters that the scene lacks and values out of range are refused. */
int pm_scene_parameters_choose(const struct pm_scene *scene, const double typed[PM_SCENE_ROWS], double *value);

#endif
