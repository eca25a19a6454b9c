/* Gauss-Seidel sweeps over red nodes (i + j + k even), then black ones; shared by red-black and red-black-sor. Nodes of a colour are not coupled, so the
 * rows are independent, except across the seam of a periodic axis of odd length: rows at its end are done after the others.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_RED_BLACK_SWEEP_H
#define PM_RED_BLACK_SWEEP_H

#include "relax/relax.h"

double pm_red_black_sweep(struct pm_relax_work *w);
/* Is the order consistent? If every neighbour has the other colour. */
double pm_red_black_radius(const struct pm_laplacian *l, double factor);

#endif
