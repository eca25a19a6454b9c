/* The potential of the particles in free space on the faces of a mesh (boundary-sum.c). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_BOUNDARY_SUM_H
#define PM_POISSON_BOUNDARY_SUM_H

#include "law/law.h"
#include "poisson/boundary.h"

/* Header: reads positions and strengths of the sets that make the density; 0, or failure where there are none. */
int pm_boundary_sum_declare(struct pm_frame *f, const struct pm_law *law, const struct pm_field *density);
/* Data: phi = coefficient * sum of strength * G on all faces, of component c. 0 or failure. */
int pm_boundary_sum(const struct pm_frame *f, const struct pm_law *law, const struct pm_field *density, int c, double coefficient, struct pm_boundary *b);

#endif
