/* Lambda 2,1: the name of M'4 (m4prime) in the family Lambda p,r of kernels that are exact for polynomials of degree p and have r continuous
 * derivatives. Cottet, Etancelin, Perignon and Picard (2014), ESAIM: M2AN 48, 1029. Conserves total, centre and second moment;
 * negative down to -2/27. 4 points per axis.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "kernel/kernel.h"
#include "kernel/m4prime.h"

const struct pm_kernel kernel_lambda_2_1 = {
	.name = "lambda-2-1",
	.sentence = "another name of m4prime",
	.source = "Cottet, Etancelin, Perignon and Picard (2014), ESAIM: M2AN 48, 1029",
	.width = 4,
	.moments = 2,
	.smooth = 1,
	.positive = false,
	.degree = 3,
	.coefficients = pm_m4prime,
};
