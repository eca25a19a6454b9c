/* The charge that a face of the box has collected: the constant charge_x_low, charge_x_high, charge_y_low ... of a frame that has it (smod --constant
 * charge_x_low=0 makes the face an electrode). push and walk add what particles leave there, inject takes away what it emits there.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_ELECTRODE_CHARGE_H
#define PM_PUSH_ELECTRODE_CHARGE_H

#include "stream/frame.h"

enum { PM_ELECTRODE_NAME = 24 };

/* The name of that constant; side 0 low, 1 high. */
void pm_electrode_name(int axis, int side, char name[PM_ELECTRODE_NAME]);
bool pm_electrode(const struct pm_frame *f, int axis, int side); /* has the frame that constant? */
/* Adds a charge, in a frame that has the constant; in frame() of a stage that holds the header back. */
void pm_electrode_add(struct pm_frame *f, int axis, int side, double charge);
/* Adds the charges of the particles of the set that are beyond absorbing faces; one beyond several counts for the first axis. */
void pm_electrodes_collect(struct pm_frame *f, const char *set);

#endif
