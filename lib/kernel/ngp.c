/* Nearest grid point: W(x) = 1 for -1/2 <= -x < 1/2, else 0. The whole strength goes to the nearest point, ties go up.
 * Hockney and Eastwood (1988) 5-2. Conserves the total; the force jumps at cell faces. 1 point per axis.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "kernel/kernel.h"

static const double coefficients[] = { /* [power of t][point] */
	1,
};

const struct pm_kernel kernel_ngp = {
	.name = "ngp",
	.sentence = "nearest grid point",
	.source = "Hockney and Eastwood (1988), section 5-2",
	.width = 1,
	.moments = 0,
	.smooth = -1,
	.positive = true,
	.degree = 0,
	.coefficients = coefficients,
};
