/* Cloud in cell: W(x) = 1 - |x| for |x| < 1, the linear B-spline. With t = x - floor: 1-t, t.
 * Hockney and Eastwood (1988) 5-2; t is the distance to the node below. Conserves total and centre. 2 points per axis.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "kernel/kernel.h"

static const double coefficients[] = { /* [power of t][point] */
	1, 0,
	-1, 1,
};

const struct pm_kernel kernel_cic = {
	.name = "cic",
	.sentence = "cloud in cell: linear, continuous",
	.source = "Hockney and Eastwood (1988), section 5-2",
	.width = 2,
	.moments = 1,
	.smooth = 0,
	.positive = true,
	.degree = 1,
	.coefficients = coefficients,
};
