/* Multigrid in free space: boundary values by James' method (mg-open.c; docs/methods/poisson-mg.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_MG_MG_OPEN_H
#define PM_POISSON_MG_MG_OPEN_H

#include "mesh/planes.h"
#include "poisson-mg/mg.h"

struct pm_mg_open;

/* 0, or a failure that names what can: all faces open, spacings within a factor of 8. */
int pm_mg_open_check(const struct pm_grid *g);
struct pm_mg_open *pm_mg_open_new(const struct pm_grid *g, int order); /* NULL with a message */
struct pm_mg_open *pm_mg_open_free(struct pm_mg_open *m);
/* The same for the planes of a rank: s and phi are then those, and all ranks make it and solve together. */
struct pm_mg_open *pm_mg_open_new_planes(const struct pm_grid *g, int order, const struct pm_planes *planes);
bool pm_mg_open_fits(const struct pm_mg_open *m, const struct pm_grid *g, int order, const struct pm_planes *planes);

/* As pm_mg_solve, with phi = -1/(4 pi r), ln(r)/(2 pi) or |x|/2 of a unit point source. The record counts the cycles of both solutions, and its history is
 * theirs one after the other. */
int pm_mg_open_solve(struct pm_mg_open *m, const struct pm_mg_choice *o, double c, const double *s, double *phi, struct pm_mg_record *r);

#endif
