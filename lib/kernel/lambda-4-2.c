/* Lambda 4,2: the name of M'6 (m6prime) in the family Lambda p,r of kernels that are exact for polynomials of degree p and have r continuous
 * derivatives. Cottet, Etancelin, Perignon and Picard (2014), ESAIM: M2AN 48, 1029. Conserves moments up to the fourth; negative
 * down to -.117. 6 points per axis.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "kernel/kernel.h"
#include "kernel/m6prime.h"

const struct pm_kernel kernel_lambda_4_2 = {
	.name = "lambda-4-2",
	.sentence = "another name of m6prime",
	.source = "Cottet, Etancelin, Perignon and Picard (2014), ESAIM: M2AN 48, 1029",
	.width = 6,
	.moments = 4,
	.smooth = 2,
	.positive = false,
	.degree = 5,
	.coefficients = pm_m6prime,
};
