/* The weights of M'6, which is also Lambda 4,2. -1/24, 7/24 and 13/24 are written as sums, rounded so that the weights of
 * each power add to 0 exactly; otherwise the total would drift by 1e-13 in a thousand remeshings.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_KERNEL_M6PRIME_H
#define PM_KERNEL_M6PRIME_H

static const double pm_m6prime[] = { /* [power of t][point] */
	0, 0, 1, 0, 0, 0,
	1. / 12, -2. / 3, 0, 2. / 3, -1. / 12, 0,
	0.625 - 2. / 3, 2. / 3, -1.25, 2. / 3, 0.625 - 2. / 3, 0,
	-0.375, 1.625, -35. / 12, 2.75, -1.375, 35. / 12 - 2.625,
	0.5 - 61. / 24 + 31. / 6 - 5.25 + 8. / 3, -8. / 3, 5.25, -31. / 6, 61. / 24, -0.5,
	-5. / 24, 25. / 24, -25. / 12, 25. / 12, -25. / 24, 5. / 24,
};

#endif
