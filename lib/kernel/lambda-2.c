/* Lambda 2: quadratic interpolation through the three nearest points, 1 - x^2 for |x| < 1/2, (x^2 - 3|x| + 2)/2 for |x| < 3/2. Of the three-point kernels
 * that with exact second moment; it jumps by 3/8 at 1/2 and by 1/8 at 3/2, and these jumps make noise in time. Negative down to -1/8.
 * With t from the nearest point: (t^2 - t)/2, 1 - t^2, (t^2 + t)/2. Source: Cottet and Koumoutsakos (2000), section 7.2. Conserves total, centre and second
 * moment. 3 points per axis. SPDX-License-Identifier: GPL-3.0-or-later */
#include "kernel/kernel.h"

static const double coefficients[] = { /* [power of t][point] */
	0, 1, 0,
	-0.5, 0, 0.5,
	0.5, -1, 0.5,
};

const struct pm_kernel kernel_lambda_2 = {
	.name = "lambda-2",
	.sentence = "quadratic interpolation, three points, with jumps",
	.source = "Cottet and Koumoutsakos (2000), section 7.2",
	.width = 3,
	.moments = 2,
	.smooth = -1,
	.positive = false,
	.degree = 2,
	.coefficients = coefficients,
};
