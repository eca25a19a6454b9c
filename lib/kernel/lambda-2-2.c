/* Lambda 2,2: interpolates, exact for polynomials of degree 2, with 2 continuous derivatives. On every cell it is the polynomial of degree 5 whose first
 * 2 derivatives at the nodes are the centred differences of order 2. Cottet, Etancelin, Perignon and Picard (2014), ESAIM: M2AN 48, 1029.
 * Conserves total, centre and second moment; negative lobes. For t > 1/2 the weights are computed from the point above (kernel.h): powers of |x| would lose
 * more digits. 4 points per axis.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "kernel/kernel.h"

static const double coefficients[] = { /* [power of t][point] */
	0, 1, 0, 0,
	-0.5, 0, 0.5, 0,
	0.5, -1, 0.5, 0,
	1.5, -4.5, 4.5, -1.5,
	-2.5, 7.5, -7.5, 2.5,
	1, -3, 3, -1,
};

const struct pm_kernel kernel_lambda_2_2 = {
	.name = "lambda-2-2",
	.sentence = "exact for quadratics, two continuous derivatives, 4 points per axis",
	.source = "Cottet, Etancelin, Perignon and Picard (2014), ESAIM: M2AN 48, 1029",
	.width = 4,
	.moments = 2,
	.smooth = 2,
	.positive = false,
	.degree = 5,
	.coefficients = coefficients,
};
