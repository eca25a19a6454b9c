/* Multigrid for div(eps grad phi) = f with a coefficient that varies and jumps (mg-variable.c; docs/methods/poisson-mg.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_MG_MG_VARIABLE_H
#define PM_POISSON_MG_MG_VARIABLE_H

#include "poisson-mg/mg.h"

PM_C_BEGIN

enum pm_mg_mean { PM_MG_HARMONIC, PM_MG_ARITHMETIC }; /* eps on a face from the nodes on its two sides */
extern const char *const pm_mg_mean_names[];          /* NULL ends */

struct pm_mg_variable; /* the hierarchy of grids and matrices, for one grid and one eps */

/* eps on the points of the grid; NULL: 1. NULL with a message, also where eps is not positive or the faces are others than those of pm_mg_check. */
struct pm_mg_variable *pm_mg_variable_new(const struct pm_grid *g, const double *eps, enum pm_mg_mean mean);
struct pm_mg_variable *pm_mg_variable_free(struct pm_mg_variable *v);
bool pm_mg_variable_fits(const struct pm_mg_variable *v, const struct pm_grid *g, const double *eps, enum pm_mg_mean mean);

/* As pm_mg_solve: div(eps grad phi) = c*s by conjugate gradients preconditioned with a cycle (FMG: the first guess by full multigrid, then V). One cycle of the
 * record is one iteration. */
int pm_mg_variable_solve(struct pm_mg_variable *v, const struct pm_mg_choice *o, double c, const double *s, double *phi, struct pm_mg_record *r);

/* eps on the face between two nodes. */
double pm_mg_face(enum pm_mg_mean mean, double a, double b);

PM_C_END

#endif
