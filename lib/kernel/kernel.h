/* Interpolation kernels between particles and meshes. One file per kernel; each states its properties, and tests/unit checks all of them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_KERNEL_H
#define PM_KERNEL_H

#include "base/base.h"

PM_C_BEGIN

enum { PM_KERNEL_WIDTH = 10, PM_KERNEL_DEGREE = 15 }; /* the largest width */

struct pm_kernel {
	const char *name, *sentence, *source;
	int width;      /* mesh points touched per axis */
	int moments;    /* discrete moments 0..moments of sum_i (x_i - x)^k W are exact (1, 0, 0, ...) */
	int smooth;     /* continuous derivatives: -1 jumps, 0 continuous, 1 ... */
	bool positive;
	bool star;      /* not a product of the axes: the base point and its neighbours along each axis; moments mixed of several axes are not exact */
	/* The weights of the `width` points around a particle, polynomials in t: coefficients[power][point], powers 0..degree.
	 * odd widths: points nearest-(width-1)/2 ..., t = x/h - nearest point in [-1/2,1/2);
	 * even widths: points floor-(width/2-1) ..., t = x/h - floor in [0,1). Where the degree is >= width or 9, t is measured from the nearest node:
	 * for t > 1/2 the weights are those of 1 - t in the opposite order (kernels are even). Powers of t up to 1 would lose digits at high order. */
	int degree;
	const double *coefficients;
};

extern const struct pm_kernel *const pm_kernels[]; /* generated from lib/kernel/, NULL ends */
extern const char *const pm_kernel_names[];
const struct pm_kernel *pm_kernel_find(const char *name); /* NULL with a message */

/* The B-spline one order lower (cic of tsc), or NULL where k is none, or ngp. */
static inline const struct pm_kernel *pm_kernel_lower(const struct pm_kernel *k)
{
	const bool spline = k->positive && !k->star && k->degree == k->width - 1;
	for (int i = 0; pm_kernels[i] && spline; i++)
		if (pm_kernels[i]->positive && !pm_kernels[i]->star && pm_kernels[i]->width == k->width - 1 && pm_kernels[i]->degree == k->degree - 1)
			return pm_kernels[i];
	return NULL;
}

/* Must t be measured from the point above? */
static inline bool pm_kernel_folds(int width, int degree, double t) { return width % 2 == 0 && (degree >= width || degree >= 9) && t > 0.5; }

/* w[0..width-1] at t, by Horner. */
static inline void pm_kernel_weights(const struct pm_kernel *k, double t, double *w)
{
	bool fold = pm_kernel_folds(k->width, k->degree, t);
	double s = fold ? 1 - t : t;
	for (int i = 0; i < k->width; i++) {
		double sum = k->coefficients[k->degree * k->width + i];
		for (int power = k->degree - 1; power >= 0; power--)
			sum = sum * s + k->coefficients[power * k->width + i];
		w[fold ? k->width - 1 - i : i] = sum;
	}
}

PM_C_END

#endif
