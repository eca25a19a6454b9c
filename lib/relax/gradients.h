/* Conjugate gradients for -lap u = -f in the inner product with quadrature weights; shared by cg and ssor-cg. With r = lap u - f and M a preconditioner:
 *   z = r/M, p = z + (<r,z>/<r,z>_before) p, a = <r,z>/<p,-lap p>, u += a p, r += a lap p
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_RELAX_GRADIENTS_H
#define PM_RELAX_GRADIENTS_H

#include <string.h>

#include "relax/relax.h"

/* (sqrt K - 1)/(sqrt K + 1), K the ratio of the largest to the smallest eigenvalue but 0. */
static inline double pm_gradients_bound(const struct pm_laplacian *l)
{
	double root = sqrt((1 - l->lowest) / (1 - l->highest));
	return (root - 1) / (root + 1);
}

static inline void pm_gradients_add(const struct pm_laplacian *l, double a, const double *restrict x, double b, double *restrict y) /* y = a x + b y */
{
	#pragma omp parallel for schedule(static) if (l->size > pm_laplacian_parallel)
	for (size_t i = 0; i < l->size; i++)
		y[i] = a * x[i] + b * y[i];
}

/* extra[0] = r, [1] = p, [2] = lap p, and [3] = z where there is a preconditioner, which may turn the sign of z: u and r do not notice. */
static inline double pm_gradients_sweep(struct pm_relax_work *w, void (*precondition)(struct pm_relax_work *w, const double *r, double *z))
{
	const struct pm_laplacian *l = w->lap;
	double *r = w->extra[0], *p = w->extra[1], *q = w->extra[2], *z = precondition ? w->extra[3] : r;
	if (w->fresh) {
		pm_laplacian_residual(l, w->u, w->f, r, w->sums);
		if (precondition)
			precondition(w, r, z);
		memcpy(p, z, l->size * sizeof *p);
		w->memory = pm_laplacian_product(l, r, z, w->sums);
		w->fresh = false;
	}
	double curvature = -pm_laplacian_apply(l, p, q, w->sums);
	if (!(curvature > 0))
		return pm_laplacian_product(l, r, r, w->sums);
	double step = w->memory / curvature;
	pm_gradients_add(l, step, p, 1, w->u);
	pm_gradients_add(l, step, q, 1, r);
	if (precondition)
		precondition(w, r, z);
	double now = pm_laplacian_product(l, r, z, w->sums);
	pm_gradients_add(l, 1, z, w->memory != 0 ? now / w->memory : 0, p);
	w->memory = now;
	return precondition ? pm_laplacian_product(l, r, r, w->sums) : now;
}

#endif
