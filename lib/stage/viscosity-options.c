/* Where the viscosity comes from, and what is said where it is 0 or negative. SPDX-License-Identifier: GPL-3.0-or-later */
#include "stage/viscosity-options.h"

double pm_viscosity(const struct pm_frame *f, double typed) { return isnan(typed) ? pm_frame_constant(f, "nu", 0) : typed; }

int pm_viscosity_check(struct pm_stage *s, double nu)
{
	if (!(nu >= 0))
		return pm_fail(PM_DATA, "the viscosity nu is %g: negative diffusion has no solution (--nu, or the scene's)", nu);
	return nu == 0 ? pm_idle(s, "the viscosity nu is 0") : 0;
}
