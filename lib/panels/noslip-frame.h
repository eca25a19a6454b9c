/* Walls without slip in a frame: what the word noslip does. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_NOSLIP_FRAME_H
#define PM_NOSLIP_FRAME_H

#include "panels/panels-frame.h"

struct pm_noslip_job {
	struct pm_panels_job wall;
	const char *on;          /* the set of vortices */
	double nu;               /* [length^2/time] */
};
struct pm_noslip_done {
	double slip;             /* [velocity] the largest before the word */
	double force[2], torque; /* on the body, over the density of the fluid: of the impulse, and about the origin of the angular impulse */
	double given;            /* [length^2/time] circulation that the wall gave to the fluid */
	size_t plain;            /* panels whose vorticity has its circulation, but not its moments */
};

/* Each 0 or failure. The law has vortices in the plane. */
int pm_noslip_law(const struct pm_frame *f);
/* Header: the set of panels; the circulations change. nu is set by the caller. */
int pm_noslip_declare(const struct pm_panels_choice *c, struct pm_frame *f, struct pm_noslip_job *job);
/* Data. */
int pm_noslip_apply(const struct pm_panels_choice *c, struct pm_frame *f, const struct pm_noslip_job *job, struct pm_panels_solver *solver,
	struct pm_noslip_done *done);

#endif
