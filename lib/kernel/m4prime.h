/* The weights of M'4, which is also Lambda 2,1.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_KERNEL_M4PRIME_H
#define PM_KERNEL_M4PRIME_H

static const double pm_m4prime[] = { /* [power of t][point] */
	0, 1, 0, 0,
	-0.5, 0, 0.5, 0,
	1, -2.5, 2, -0.5,
	-0.5, 1.5, -1.5, 0.5,
};

#endif
