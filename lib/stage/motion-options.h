/* Options that scale, rotate, shift and boost particles: those of smove, which smod still accepts. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_MOTION_OPTIONS_H
#define PM_STAGE_MOTION_OPTIONS_H

#include "mesh/set-motion.h"
#include "stage/stage.h"

struct pm_motion_options {
	struct pm_list sets, scale;
	struct pm_vector shift, boost;
	const char *rotate;
};

/* Rows of options, for a struct config with the member `motion` of this type. */
#define PM_MOTION_ROWS \
	{.name = "set", .kind = PM_LIST, .unit = "NAME", PM_AT(motion.sets), .text = "move and scale only these sets (default: all sets)"}, \
	{.name = "scale", .kind = PM_LIST, .unit = "FIELD=FACTOR", PM_AT(motion.scale), \
		.text = "multiply fields: x=2,v=0.5,mass=1e-3; box=2 stretches the box and its meshes about the origin"}, \
	{.name = "rotate", .kind = PM_TEXT, .unit = "AXIS,DEGREES", PM_AT(motion.rotate), \
		.text = "rotate x and v about the origin, such as z,30; in 2-D only z"}, \
	{.name = "shift", .kind = PM_VECTOR, .unit = "length", PM_AT(motion.shift), .text = "add to the positions (wrapped into the box on periodic axes)"}, \
	{.name = "boost", .kind = PM_VECTOR, .unit = "length/time", PM_AT(motion.boost), .text = "add to the velocities"}

/* Was any of these options given? */
bool pm_motion_given(const struct pm_motion_options *o);
/* begin(): the rotation. declare(): the factors, checked against the frame. 0 or failure. */
int pm_motion_begin(const struct pm_motion_options *o, struct pm_set_motion *m);
int pm_motion_check(const struct pm_motion_options *o, struct pm_set_motion *m, const struct pm_frame *f);

#endif
