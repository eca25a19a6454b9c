/* A sum over particles made exact at rims and between irregular particles (docs/methods/sample.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_NEAR_SAMPLE_CORRECTION_H
#define PM_NEAR_SAMPLE_CORRECTION_H

#include "base/base.h"

enum pm_sample_correction { PM_SAMPLE_NONE, PM_SAMPLE_UNITY, PM_SAMPLE_LINEAR };
extern const char *const pm_sample_correction_names[]; /* NULL ends */

/* u[k] of n points from sums with z = (x - x_p)/eps: sum[] of the strengths times zeta and zeta z_d, moment[] of the volumes times zeta, zeta z_d and
 * zeta z_d z_e, d <= e in the order xx xy xz yy yz zz. Unity needs the first of both alone. bare: points with hardly a volume in reach, for which u is the sum
 * as it is. */
void pm_sample_correct(enum pm_sample_correction c, int dim, size_t n, const double *const sum[], const double *const moment[], double *u, size_t *bare);

#endif
