/* Lambda 6,6: interpolates, exact for polynomials of degree 6, with 6 continuous derivatives. On every cell it is the polynomial of degree 13 whose first
 * 6 derivatives at the nodes are the centred differences of order 6. Cottet, Etancelin, Perignon and Picard (2014), ESAIM: M2AN 48, 1029.
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
	-1. / 240, 1. / 60, -1. / 48, 0, 1. / 48, -1. / 60, 1. / 240, 0,
	1. / 720, -1. / 120, 1. / 48, -1. / 36, 1. / 48, -1. / 120, 1. / 720, 0,
	6587. / 720, -46109. / 720, 46109. / 240, -46109. / 144, 46109. / 144, -46109. / 240, 46109. / 720, -6587. / 720,
	-11623. / 240, 81361. / 240, -81361. / 80, 81361. / 48, -81361. / 48, 81361. / 80, -81361. / 240, 11623. / 240,
	15563. / 144, -108941. / 144, 108941. / 48, -544705. / 144, 544705. / 144, -108941. / 48, 108941. / 144, -15563. / 144,
	-93577. / 720, 655039. / 720, -655039. / 240, 655039. / 144, -655039. / 144, 655039. / 240, -655039. / 720, 93577. / 720,
	31933. / 360, -223531. / 360, 223531. / 120, -223531. / 72, 223531. / 72, -223531. / 120, 223531. / 360, -31933. / 360,
	-11713. / 360, 81991. / 360, -81991. / 120, 81991. / 72, -81991. / 72, 81991. / 120, -81991. / 360, 11713. / 360,
	901. / 180, -6307. / 180, 6307. / 60, -6307. / 36, 6307. / 36, -6307. / 60, 6307. / 180, -901. / 180,
};

const struct pm_kernel kernel_lambda_6_6 = {
	.name = "lambda-6-6",
	.sentence = "exact for sextics, six continuous derivatives, 8 points per axis",
	.source = "Cottet, Etancelin, Perignon and Picard (2014), ESAIM: M2AN 48, 1029",
	.width = 8,
	.moments = 6,
	.smooth = 6,
	.positive = false,
	.degree = 13,
	.coefficients = coefficients,
};
