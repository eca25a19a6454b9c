/* Piecewise cubic spline (M4): the cubic B-spline, 2/3 - x^2 + |x|^3/2 for |x| <= 1, (2 - |x|)^3/6 for |x| <= 2.
 * With t = x - floor: (1-t)^3, 4 - 6t^2 + 3t^3, 1 + 3t + 3t^2 - 3t^3, t^3, over 6. Schoenberg (1946); M4 of Monaghan (1985), which
 * is not M'4. Conserves total and centre; the second moment is too large by h^2/3 per axis. 4 points per axis.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "kernel/kernel.h"

static const double coefficients[] = { /* [power of t][point] */
	(1 - 2. / 3) / 2, 2. / 3, (1 - 2. / 3) / 2, 0, /* 1/6, so rounded that the weights add to 1 exactly (a drift of 1e-13 in 1000 remeshings) */
	-0.5, 0, 0.5, 0,
	0.5, -1, 0.5, 0,
	-1. / 6, 0.5, -0.5, 1. / 6,
};

const struct pm_kernel kernel_pcs = {
	.name = "pcs",
	.sentence = "piecewise cubic spline: continuous curvature",
	.source = "Schoenberg (1946); Sefusatti et al. (2016)",
	.width = 4,
	.moments = 1,
	.smooth = 2,
	.positive = true,
	.degree = 3,
	.coefficients = coefficients,
};
