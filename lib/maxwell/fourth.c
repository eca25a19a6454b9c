/* Differences of order 4 in space, leapfrog in time: [27 (f(1/2) - f(-1/2)) - (f(3/2) - f(-3/2))]/(24 h). Waves are slower than c by (k h)^4 3/640 for short
 * steps. Stable for c dt up to 6/7 of Yee's limit. div E - rho/eps0 of two-point differences does not stay as it is with a current that keeps charge for these:
 * correct it with maxwell --gauss where charges move. Source: Fang 1989; Taflove and Hagness 2005, section 4.9. SPDX-License-Identifier: GPL-3.0-or-later */
#include "maxwell/maxwell.h"

static const struct pm_yee_stencil stencil = {.near = 27. / 24, .far = -1. / 24, .middle = {1, 1, 1}};

static double limit(const struct pm_grid *g) { return pm_yee_limit(g, 7. / 6); }
static void magnetic(const struct pm_yee *y, double dt) { pm_yee_wide(y, &stencil, false, dt); }
static void electric(const struct pm_yee *y, double dt) { pm_yee_wide(y, &stencil, true, dt); }

const struct pm_maxwell maxwell_fourth = {
	.name = "fourth",
	.sentence = "four-point differences of order 4; periodic boxes",
	.source = "Fang 1989",
	.order = 4,
	.limit = limit,
	.beside = 2,
	.magnetic = magnetic,
	.electric = electric,
};
