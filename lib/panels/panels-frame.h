/* Solid walls of panels in a frame: what the word panels does. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PANELS_FRAME_H
#define PM_PANELS_FRAME_H

#include "expression/expression.h"
#include "panels/panels.h"

struct pm_panels_choice {
	const char *curve;            /* expression "x, y" of s = 0..1, counter-clockwise; NULL: the corners are in the set */
	size_t n;                     /* panels of the curve */
	const char *velocity, *stream; /* of the wall and of the fluid at the panels, "u, v" of x, y; NULL: 0 */
	const char *name;             /* the set of panels */
	const char *set;              /* the particles that are moved; NULL: all */
	double circulation;           /* [length^2/time] of the sheet of every curve */
	double softening;             /* [length] of the vortices, as the panels feel them; NAN: the frame's constant, else from the volumes */
	bool source, replace;
};

/* From the header to the data. */
struct pm_panels_job {
	struct pm_expression curve, velocity, stream;
};

/* Each 0 or failure. Header: the set of panels, and the change vel of the particles. */
int pm_panels_declare(const struct pm_panels_choice *c, struct pm_frame *f, struct pm_panels_job *job);
/* Data. */
int pm_panels_apply(const struct pm_panels_choice *c, struct pm_frame *f, const struct pm_panels_job *job, struct pm_panels_solver *solver,
	struct pm_panels_solved *done);

#endif
