/* Triangular shaped cloud: the quadratic B-spline, 3/4 - x^2 for |x| <= 1/2, (3/2 - |x|)^2/2 for |x| <= 3/2.
 * With t from the nearest point: (1/2 - t)^2/2, 3/4 - t^2, (1/2 + t)^2/2. Hockney and Eastwood (1988) 5-3. Conserves total and centre;
 * the second moment is too large by the constant h^2/4 per axis. 3 points per axis.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "kernel/kernel.h"

static const double coefficients[] = { /* [power of t][point] */
	0.125, 0.75, 0.125,
	-0.5, 0, 0.5,
	0.5, -1, 0.5,
};

const struct pm_kernel kernel_tsc = {
	.name = "tsc",
	.sentence = "triangular shaped cloud: quadratic, continuous slope",
	.source = "Hockney and Eastwood (1988), section 5-3",
	.width = 3,
	.moments = 1,
	.smooth = 1,
	.positive = true,
	.degree = 2,
	.coefficients = coefficients,
};
