/* The error of a force on a mesh, and how large it may be. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PLANNER_FORCE_ERROR_H
#define PM_PLANNER_FORCE_ERROR_H

#include "planner/atlas.h"
#include "planner/scales.h"

/* A relative force error d shifts frequencies by d/2 and phases by d omega T/2 within the run, which limits d. */
double pm_force_allowed(const struct pm_scales *s);
/* The relative error of a force by a row of the atlas, with `factor` times the cells; h: of the frame's mesh over the length of the field. */
double pm_force_error(const struct pm_scales *s, const struct pm_atlas_force *r, double h, int factor);

#endif
