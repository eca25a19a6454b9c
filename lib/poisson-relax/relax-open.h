/* Boundary values of a box in free space for the iterative solvers (relax-open.c). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_RELAX_RELAX_OPEN_H
#define PM_POISSON_RELAX_RELAX_OPEN_H

#include "mesh/grid.h"

struct pm_outer; /* the way from charges on the surface of a box to its boundary values */

bool pm_outer_wanted(const struct pm_grid *g);            /* is any face open? */
int pm_outer_check(const struct pm_grid *g);              /* 0, or a failure that names what can */
struct pm_outer *pm_outer_new(const struct pm_grid *g);   /* NULL with a message */
struct pm_outer *pm_outer_free(struct pm_outer *o);
struct pm_grid pm_outer_walled(const struct pm_grid *g);  /* the box, grounded */

/* From the solution phi between walls with source c*s: boundary values in wall, zero inside, and f, the source between walls for phi less these. Both of the
 * points of the grid; owned by o. 0 or a failure. */
int pm_outer_values(struct pm_outer *o, double c, const double *s, const double *phi, const double **wall, const double **f);

#endif
