/* Closed surfaces of triangles in a frame: what the word panels does in space. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PANELS_SURFACE_FRAME_H
#define PM_PANELS_SURFACE_FRAME_H

#include "panels/panels-frame.h"

/* Each 0 or failure. Header: the set of panels, and the changes vel and, of vortices, dalpha of the particles. */
int pm_surface_declare(const struct pm_panels_choice *c, struct pm_frame *f, struct pm_panels_job *job);
/* Data. */
int pm_surface_apply(const struct pm_panels_choice *c, struct pm_frame *f, const struct pm_panels_job *job, struct pm_panels_solver *solver,
	struct pm_panels_solved *done);

#endif
