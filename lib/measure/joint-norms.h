/* The norms of the differences of two frames in a joint frame (stream/joint-frame.h): its declare() and frame(), as a stage has them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_JOINT_NORMS_H
#define PM_MEASURE_JOINT_NORMS_H

#include "measure/norms.h"

void pm_joint_declare(struct pm_frame *joint);
int pm_joint_norms(struct pm_frame *joint, struct pm_norms *norms); /* norms: one of each pair */

#endif
