/* Lambda 6,4: interpolates, exact for polynomials of degree 6, with 4 continuous derivatives. On every cell it is the polynomial of degree 9 whose first
 * 4 derivatives at the nodes are the centred differences of order 6. Cottet, Etancelin, Perignon and Picard (2014), ESAIM: M2AN 48, 1029.
 * Conserves moments up to the sixth; negative lobes. For t > 1/2 the weights are computed from the point above (kernel.h): powers of |x| would lose up to
 * nine digits. 8 points per axis.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "kernel/kernel.h"

static const double coefficients[] = { /* [power of t][point] */
	0, 0, 0, 1, 0, 0, 0, 0,
	-1. / 60, 3. / 20, -0.75, 0, 0.75, -3. / 20, 1. / 60, 0,
	1. / 180, -3. / 40, 0.75, -49. / 36, 0.75, -3. / 40, 1. / 180, 0,
	1. / 48, -1. / 6, 13. / 48, 0, -13. / 48, 1. / 6, -1. / 48, 0,
	-1. / 144, 1. / 12, -13. / 48, 7. / 18, -13. / 48, 1. / 12, -1. / 144, 0,
	25. / 36, -3509. / 720, 293. / 20, -3521. / 144, 881. / 36, -14.6875, 881. / 180, -503. / 720,
	-859. / 360, 4009. / 240, -3007. / 60, 12029. / 144, -2005. / 24, 12031. / 240, -752. / 45, 191. / 80,
	2231. / 720, -15617. / 720, 15617. / 240, -15617. / 144, 15617. / 144, -15617. / 240, 15617. / 720, -2231. / 720,
	-1.8125, 12.6875, -38.0625, 63.4375, -63.4375, 38.0625, -12.6875, 1.8125,
	29. / 72, -203. / 72, 203. / 24, -1015. / 72, 1015. / 72, -203. / 24, 203. / 72, -29. / 72,
};

const struct pm_kernel kernel_lambda_6_4 = {
	.name = "lambda-6-4",
	.sentence = "exact for sextics, four continuous derivatives, 8 points per axis",
	.source = "Cottet, Etancelin, Perignon and Picard (2014), ESAIM: M2AN 48, 1029",
	.width = 8,
	.moments = 6,
	.smooth = 4,
	.positive = false,
	.degree = 9,
	.coefficients = coefficients,
};
