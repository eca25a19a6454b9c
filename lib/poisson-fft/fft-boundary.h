/* Given boundary values with the spectral symbol and those of order 4 and 6 (fft-boundary.c; docs/methods/boundary-values.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_FFT_BOUNDARY_H
#define PM_POISSON_FFT_BOUNDARY_H

#include "poisson-fft/fft-solvers.h"
#include "poisson/boundary.h"

/* Adds to phi, the solution with homogeneous faces, the harmonic function with these boundary values. 0, or failure, also where they are not
 * 0 on an edge of two walls. */
int pm_poisson_fft_boundary(struct pm_fft_solvers *s, const struct pm_poisson_fft_choice *o, const struct pm_boundary *b, double *phi);
/* 0, or the sentence that says which choice has no boundary values. */
int pm_poisson_fft_boundary_check(const struct pm_grid *g, const struct pm_poisson_fft_choice *o);

#endif
