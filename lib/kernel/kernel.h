/* Interpolation kernels between particles and meshes. One file per kernel; each states its promises and tests/unit checks every one.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_KERNEL_H
#define PM_KERNEL_H

#include "base/base.h"

enum { PM_KERNEL_WIDTH = 8 }; /* the widest */

struct pm_kernel {
	const char *name, *sentence, *source;
	int width;      /* mesh points touched per axis */
	int moments;    /* discrete moments 0..moments of sum_i (x_i - x)^k W are exact (1, 0, 0, ...) */
	int smooth;     /* continuous derivatives: -1 jumps, 0 continuous, 1 ... */
	bool positive;
	/* The weights of the `width` points around a particle. odd widths: points nearest-(width-1)/2 ..., t = x/h - nearest point in [-1/2,1/2);
	 * even widths: points floor-(width/2-1) ..., t = x/h - floor in [0,1). Horner about the nearest node. */
	void (*weights)(double t, double *w);
};

extern const struct pm_kernel *const pm_kernels[]; /* generated from lib/kernel/, NULL ends */
extern const char *const pm_kernel_names[];
const struct pm_kernel *pm_kernel_find(const char *name); /* NULL with a message */

#endif
