/* Boundary values of a box in free space for solvers between walls (lib/james/james.c). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_JAMES_JAMES_H
#define PM_JAMES_JAMES_H

#include "mesh/grid.h"

struct pm_james; /* the way from charges on the surface of a box to its boundary values */

bool pm_james_wanted(const struct pm_grid *g);            /* is any face open? */
int pm_james_check(const struct pm_grid *g);              /* 0, or a failure that names what can */
struct pm_james *pm_james_new(const struct pm_grid *g);   /* NULL with a message */
struct pm_james *pm_james_free(struct pm_james *o);
struct pm_grid pm_james_walled(const struct pm_grid *g);  /* the box, grounded */

/* From the solution phi between walls with source c*s: boundary values in wall, zero inside, and f, the source between walls for phi less these. Both of the
 * points of the grid; owned by o. 0 or a failure. */
int pm_james_values(struct pm_james *o, double c, const double *s, const double *phi, const double **wall, const double **f);

#endif
