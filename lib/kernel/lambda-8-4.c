/* Lambda 8,4: interpolates, exact for polynomials of degree 8, with 4 continuous derivatives. On every cell it is the polynomial of degree 9 whose first
 * 4 derivatives at the nodes are the centred differences of order 8. Cottet, Etancelin, Perignon and Picard (2014), ESAIM: M2AN 48, 1029.
 * Conserves moments up to the eighth; negative lobes. For t > 1/2 the weights are computed from the point above (kernel.h): powers of |x| would lose up to
 * nine digits. 10 points per axis.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "kernel/kernel.h"

static const double coefficients[] = { /* [power of t][point] */
	0, 0, 0, 0, 1, 0, 0, 0, 0, 0,
	1. / 280, -4. / 105, 1. / 5, -4. / 5, 0, 4. / 5, -1. / 5, 4. / 105, -1. / 280, 0,
	-1. / 1120, 4. / 315, -1. / 10, 4. / 5, -205. / 144, 4. / 5, -1. / 10, 4. / 315, -1. / 1120, 0,
	-7. / 1440, 1. / 20, -169. / 720, 61. / 180, 0, -61. / 180, 169. / 720, -1. / 20, 7. / 1440, 0,
	7. / 5760, -1. / 60, 169. / 1440, -61. / 180, 91. / 192, -61. / 180, 169. / 1440, -1. / 60, 7. / 5760, 0,
	-175. / 1152, 175. / 128, -1579. / 288, 3697. / 288, -6181. / 320, 11149. / 576, -3719. / 288, 177. / 32, -1591. / 1152, 883. / 5760,
	503. / 960, -2263. / 480, 13577. / 720, -31681. / 720, 6337. / 96, -2971. / 45, 31697. / 720, -4529. / 240, 13589. / 2880, -151. / 288,
	-1961. / 2880, 41179. / 6720, -30883. / 1260, 5147. / 90, -2745. / 32, 123523. / 1440, -20587. / 360, 2941. / 120, -123523. / 20160, 305. / 448,
	16061. / 40320, -36137. / 10080, 144547. / 10080, -24091. / 720, 28909. / 576, -4517. / 90, 48181. / 1440,
		-72271. / 5040, 144541. / 40320, -803. / 2016,
	-3569. / 40320, 3569. / 4480, -3569. / 1120, 3569. / 480, -3569. / 320, 3569. / 320, -3569. / 480, 3569. / 1120, -3569. / 4480, 3569. / 40320,
};

const struct pm_kernel kernel_lambda_8_4 = {
	.name = "lambda-8-4",
	.sentence = "exact for octics, four continuous derivatives, 10 points per axis",
	.source = "Cottet, Etancelin, Perignon and Picard (2014), ESAIM: M2AN 48, 1029",
	.width = 10,
	.moments = 8,
	.smooth = 4,
	.positive = false,
	.degree = 9,
	.coefficients = coefficients,
};
