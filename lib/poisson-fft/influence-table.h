/* Influence functions as tables over the modes of a mesh: the inside of the solver. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_FFT_INFLUENCE_TABLE_H
#define PM_POISSON_FFT_INFLUENCE_TABLE_H

#include "poisson-fft/influence.h"

/* The transforms of a kernel and of the cloud, 1 at 0; theta [radians per cell], u = k a/2. */
double pm_kernel_wave(const struct pm_kernel *k, double theta);
double pm_cloud_wave(double u);

/* One axis of a table: mode m of n, waves theta = 2 pi (m/n + alias). */
struct pm_influence_axis {
	size_t count;                 /* modes 0 ... n/2 */
	int aliases;                  /* of each: -reach ... reach */
	double *lambda;               /* [count] of the second difference or -k^2 */
	double *slope;                /* [count] of the first derivative: D(k), 1/length */
	double *all, *even;           /* [count] sum over aliases of W^2, and with the sign of the alias */
	double *k, *window;           /* [count][aliases] wave number, W^2 */
};
int pm_influence_axis_init(struct pm_influence_axis *a, const struct pm_influence *f, size_t n, double h,
	double (*lambda)(const void *c, double theta, double h), const void *context);
void pm_influence_axis_free(struct pm_influence_axis *a);

/* For all modes of x at modes j of y and k of z, what is to stand in place of 1/(lambda - screening2). */
void pm_influence_row(const struct pm_influence *f, const struct pm_influence_axis axis[3], double screening2, size_t j, size_t k, double *row);

#endif
