/* The viscosity of the words that diffuse (diffuse, pse, walk): the option --nu, else the frame's constant.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_VISCOSITY_OPTIONS_H
#define PM_STAGE_VISCOSITY_OPTIONS_H

#include "stage/stage.h"

/* A row of options, for a struct config with the member `double nu`. */
#define PM_VISCOSITY_ROW \
	{.name = "nu", .kind = PM_REAL, .unit = "length^2/time", .high = 1e300, PM_AT(nu), .text = "the viscosity (default: the frame's constant nu)"}

/* nu [length^2/time] as typed, NAN where it was not. */
double pm_viscosity(const struct pm_frame *f, double typed);
/* declare(): 0; PM_PASS, and says so once, where nu is 0; or failure where it is negative. */
int pm_viscosity_check(struct pm_stage *s, double nu);

#endif
