/* Positions and velocities rotated, shifted and wrapped into the box. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_RIGID_MOTION_H
#define PM_MESH_RIGID_MOTION_H

#include "stream/frame.h"

struct pm_turn {
	int axis[2];         /* the first rotates towards the second; -1: no rotation */
	double cosine, sine;
};

int pm_turn_of(const char *text, struct pm_turn *t); /* "z,30": right-handed, in degrees, quarter turns exact; NULL: none */
void pm_move_turn(const struct pm_turn *t, struct pm_field *p);
void pm_move_add(struct pm_field *p, int n, const double *by);
void pm_move_fold(const struct pm_frame *f, struct pm_field *x); /* wrapped on periodic axes; the upper end becomes the lower */

#endif
