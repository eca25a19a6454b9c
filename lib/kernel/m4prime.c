/* M'4 (Lambda 2,1; Catmull-Rom): 1 - 5/2 x^2 + 3/2 |x|^3 for |x| <= 1, (2 - |x|)^2 (1 - |x|)/2 for |x| <= 2. Monaghan (1985);
 * some texts print the outer branch wrongly with (1 + |x|). With t = x - floor: -t(1-t)^2/2, 1 - 5/2 t^2 + 3/2 t^3, t/2 + 2t^2 - 3/2 t^3,
 * -t^2(1-t)/2. Exact for quadratics: conserves total, centre and second moment; negative down to -2/27. 4 points per axis.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "kernel/kernel.h"
#include "kernel/m4prime.h"

const struct pm_kernel kernel_m4prime = {
	.name = "m4prime",
	.sentence = "M'4: exact for quadratics, negative lobes",
	.source = "Monaghan (1985), J. Comput. Phys. 60, 253",
	.width = 4,
	.moments = 2,
	.smooth = 1,
	.positive = false,
	.degree = 3,
	.coefficients = pm_m4prime,
};
