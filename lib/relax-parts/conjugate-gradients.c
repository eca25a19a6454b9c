/* A step of conjugate gradients (conjugate-gradients.h). Cost: one product with lap, two sums and three additions of meshes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "relax-parts/conjugate-gradients.h"

double pm_gradients_bound(const struct pm_laplacian *l)
{
	double root = sqrt((1 - l->lowest) / (1 - l->highest));
	return (root - 1) / (root + 1);
}

static void add(const struct pm_laplacian *l, double a, const double *restrict x, double b, double *restrict y) /* y = a x + b y */
{
	#pragma omp parallel for schedule(static) if (l->size > pm_laplacian_parallel)
	for (size_t i = 0; i < l->size; i++)
		y[i] = a * x[i] + b * y[i];
}

double pm_gradients_sweep(struct pm_relax_work *w, void (*precondition)(struct pm_relax_work *w, const double *r, double *z))
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
	add(l, step, p, 1, w->u);
	add(l, step, q, 1, r);
	if (precondition)
		precondition(w, r, z);
	double now = pm_laplacian_product(l, r, z, w->sums);
	add(l, 1, z, w->memory != 0 ? now / w->memory : 0, p);
	w->memory = now;
	return precondition ? pm_laplacian_product(l, r, r, w->sums) : now;
}
