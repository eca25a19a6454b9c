/* Jacobi's sweep with a factor, shared by jacobi and weighted-jacobi. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_JACOBI_SWEEP_H
#define PM_JACOBI_SWEEP_H

#include "relax/relax.h"

/* u + (factor/diagonal) (lap u - f), from old values only: the rows are independent. */
double pm_jacobi_sweep(struct pm_relax_work *w);
/* Spectral radius: the eigenvalues are 1 - factor (1 - mu), mu those of the average over neighbours. */
double pm_jacobi_radius(const struct pm_laplacian *l, double factor);

#endif
