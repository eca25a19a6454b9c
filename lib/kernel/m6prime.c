/* M'6 (M6*, Lambda 4,2): 1 - 5/4 x^2 - 35/12 |x|^3 + 21/4 x^4 - 25/12 |x|^5 for |x| <= 1, and two more branches to |x| = 3, whose published form in powers
 * of |x| loses three digits; here all are powers of the distance to the point below. van Rees et al. (2011), J. Comput. Phys. 230, 2794 (whose coefficients
 * 24, 38 must be 25, -38). Interpolates, exact for quartics: conserves the moments up to the fourth; negative down to -.117.
 * 6 points per axis.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "kernel/kernel.h"
#include "kernel/m6prime.h"

const struct pm_kernel kernel_m6prime = {
	.name = "m6prime",
	.sentence = "M'6: exact for quartics, continuous curvature, negative lobes",
	.source = "van Rees, Leonard, Pullin and Koumoutsakos (2011), J. Comput. Phys. 230, 2794",
	.width = 6,
	.moments = 4,
	.smooth = 2,
	.positive = false,
	.degree = 5,
	.coefficients = pm_m6prime,
};
