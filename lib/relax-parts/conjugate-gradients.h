/* Conjugate gradients for -lap u = -f in the inner product with quadrature weights; shared by cg and ssor-cg. With r = lap u - f and M a preconditioner:
 *   z = r/M, p = z + (<r,z>/<r,z>_before) p, a = <r,z>/<p,-lap p>, u += a p, r += a lap p
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CONJUGATE_GRADIENTS_H
#define PM_CONJUGATE_GRADIENTS_H

#include "relax/relax.h"

/* (sqrt K - 1)/(sqrt K + 1), K the ratio of the largest to the smallest nonzero eigenvalue. */
double pm_gradients_bound(const struct pm_laplacian *l);
/* extra[0] = r, [1] = p, [2] = lap p, and [3] = z if there is a preconditioner, which may reverse the sign of z: u and r do not depend on it. */
double pm_gradients_sweep(struct pm_relax_work *w, void (*precondition)(struct pm_relax_work *w, const double *r, double *z));

#endif
