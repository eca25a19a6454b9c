/* The bare (unsmoothed) kernels of lap phi = delta function in open space, which every mollifier approaches at large distance; at r2 = 0 they are 0, because a
 * particle does not act on itself. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MOLLIFIER_BARE_H
#define PM_MOLLIFIER_BARE_H

#include "mollifier/mollifier.h"

/* Below this r2 the force of a bare source cannot be represented in 3-D; such a pair counts as coincident. */
static const double pm_bare_least = 1e-200;

static inline double pm_bare_force(double r2, int dim)
{
	if (r2 < pm_bare_least)
		return 0;
	return dim == 1 ? 0.5 / sqrt(r2) : dim == 2 ? 0.5 / (pm_pi * r2) : 0.25 / (pm_pi * r2 * sqrt(r2));
}

static const double pm_bare_least_slope = 1e-120; /* of r2: below it the slope, and of vortices the force too, counts as that of coincident points */

static inline double pm_bare_slope(double r2) { return r2 < pm_bare_least_slope ? 0 : -0.75 / (pm_pi * r2 * r2 * sqrt(r2)); }

static inline double pm_bare_potential(double r2, int dim)
{
	if (r2 < pm_bare_least)
		return 0;
	return dim == 1 ? 0.5 * sqrt(r2) : dim == 2 ? 0.25 * log(r2) / pm_pi : -0.25 / (pm_pi * sqrt(r2));
}

#endif
