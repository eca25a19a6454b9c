/* Boundary values of a box in free space for solvers between walls (lib/james/james.c). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_JAMES_JAMES_H
#define PM_JAMES_JAMES_H

#include "mesh/planes.h"

struct pm_james; /* the way from charges on the surface of a box to its boundary values */

bool pm_james_wanted(const struct pm_grid *g);            /* is any face open? */
int pm_james_check(const struct pm_grid *g);              /* 0, or a failure that names what can */
struct pm_grid pm_james_walled(const struct pm_grid *g);  /* the box, grounded */
/* planes: NULL, or those of a rank, which all points then are; all ranks call it together, and so the next one. NULL with a message. */
struct pm_james *pm_james_new(const struct pm_grid *g, const struct pm_planes *planes);
struct pm_james *pm_james_free(struct pm_james *o);

/* From the solution u between walls with source c*s: *f, the source between walls for phi less its boundary values, of the points of the grid, owned by o. Then
 * these values, on the walls of phi. room: of as many numbers. Takes the caller's status and returns the agreed one. */
int pm_james_source(int status, struct pm_james *o, double c, const double *s, const double *u, double *room, const double **f);
void pm_james_set(const struct pm_james *o, double *phi);

#endif
