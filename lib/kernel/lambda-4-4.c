/* Lambda 4,4: interpolates, exact for polynomials of degree 4, with 4 continuous derivatives. On every cell it is the polynomial of degree 9 whose first
 * 4 derivatives at the nodes are the centred differences of order 4. Cottet, Etancelin, Perignon and Picard (2014), ESAIM: M2AN 48, 1029.
 * Conserves moments up to the fourth; negative lobes. For t > 1/2 the weights are computed from the point above (kernel.h): powers of |x| would lose up to
 * nine digits. 6 points per axis.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "kernel/kernel.h"

static const double coefficients[] = { /* [power of t][point] */
	0, 0, 1, 0, 0, 0,
	1. / 12, -2. / 3, 0, 2. / 3, -1. / 12, 0,
	-1. / 24, 2. / 3, -1.25, 2. / 3, -1. / 24, 0,
	-1. / 12, 1. / 6, 0, -1. / 6, 1. / 12, 0,
	1. / 24, -1. / 6, 0.25, -1. / 6, 1. / 24, 0,
	-10. / 3, 50. / 3, -100. / 3, 100. / 3, -50. / 3, 10. / 3,
	11.375, -56.875, 113.75, -113.75, 56.875, -11.375,
	-14.75, 73.75, -147.5, 147.5, -73.75, 14.75,
	8.625, -43.125, 86.25, -86.25, 43.125, -8.625,
	-23. / 12, 115. / 12, -115. / 6, 115. / 6, -115. / 12, 23. / 12,
};

const struct pm_kernel kernel_lambda_4_4 = {
	.name = "lambda-4-4",
	.sentence = "exact for quartics, four continuous derivatives, 6 points per axis",
	.source = "Cottet, Etancelin, Perignon and Picard (2014), ESAIM: M2AN 48, 1029",
	.width = 6,
	.moments = 4,
	.smooth = 4,
	.positive = false,
	.degree = 9,
	.coefficients = coefficients,
};
