/* Gauss-Seidel sweeps in the order of memory, and back; shared by gauss-seidel, sor and ssor-cg. A row needs the new values of the rows before it in y and
 * in z only, so in 3-D rows with the same j + k are independent and go to the threads diagonal by diagonal: the values are those of the plain order. In 1-D and
 * 2-D a sweep is serial. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LEXICOGRAPHIC_SWEEP_H
#define PM_LEXICOGRAPHIC_SWEEP_H

#include "relax/relax.h"

/* On u with right-hand side f; sums: per row, of the squared residuals, each before its node is updated. */
void pm_lexicographic_sweep(const struct pm_laplacian *l, double relaxation, double *u, const double *f, double *sums, bool forward);
double pm_lexicographic_relax(struct pm_relax_work *w);
/* Is the order consistent? Not with a periodic axis. */
double pm_lexicographic_radius(const struct pm_laplacian *l, double factor);

#endif
