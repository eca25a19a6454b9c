/* Yee's scheme: two-point differences in space, leapfrog in time. Its waves obey sin^2(omega dt/2)/(c dt)^2 = sum sin^2(k h/2)/h^2, so they are bounded for
 * c dt up to 1/sqrt(sum 1/h^2), and slower than c except along the longest diagonal at that limit. div B stays as it was, to round-off.
 * Source: Yee 1966, IEEE Transactions on Antennas and Propagation 14, 302. Cost: 36 additions a cell in 3-D, memory-bound.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "maxwell/maxwell.h"

static double limit(const struct pm_grid *g) { return pm_yee_limit(g, 1); }

const struct pm_maxwell maxwell_yee = {
	.name = "yee",
	.sentence = "two-point differences",
	.source = "Yee 1966",
	.order = 2,
	.any_face = true,
	.limit = limit,
	.beside = 1,
	.magnetic = pm_yee_magnetic,
	.electric = pm_yee_electric,
};
