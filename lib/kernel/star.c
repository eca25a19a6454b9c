/* Star: the nearest point and its neighbours along each axis, 2 dim + 1 points (five in the plane): with t from the nearest point, (t_d^2 +- t_d)/2 to the
 * neighbours along axis d and 1 - sum_d t_d^2 to the point itself. The only weights on these points with the total, the centre and the second moment along
 * each axis exact, so x^2 + y^2 (the corners of a cell, four points, cannot have it: there x^2 + y^2 is no condition of its own). The mixed moments, xy, are
 * those of the nearest point: off by t_x t_y. Along one axis it is lambda-2, with the same jumps. Negative down to -1/8 at the neighbours.
 * Source: notes on particle methods, S4-E3 (moments for which weights are chosen). 2 dim + 1 points. SPDX-License-Identifier: GPL-3.0-or-later */
#include "kernel/kernel.h"

static const double coefficients[] = { /* [power of t][point] along one axis */
	0, 1, 0,
	-0.5, 0, 0.5,
	0.5, -1, 0.5,
};

const struct pm_kernel kernel_star = {
	.name = "star",
	.sentence = "the nearest point and its neighbours along each axis, exact second moments, with jumps",
	.source = "notes on particle methods, S4-E3",
	.width = 3,
	.moments = 2,
	.smooth = -1,
	.positive = false,
	.star = true,
	.degree = 2,
	.coefficients = coefficients,
};
