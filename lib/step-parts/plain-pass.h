/* The pass of kicks, drifts and Euler's scheme: y += dt k. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STEP_PARTS_PLAIN_PASS_H
#define PM_STEP_PARTS_PLAIN_PASS_H

#include "base/base.h"

static inline void pm_plain_pass(int p, double dt, size_t n, double *restrict y, const double *restrict k, double *const *q)
{
	(void)p, (void)q;
	for (size_t i = 0; i < n; i++)
		y[i] += dt * k[i];
}

#endif
