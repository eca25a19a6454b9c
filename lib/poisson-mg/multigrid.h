/* Multigrid by options: one of the solvers of mg.h, mg-open.h and mg-variable.h for a grid, made once and kept.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_MG_MULTIGRID_H
#define PM_POISSON_MG_MULTIGRID_H

#include "poisson-mg/mg-variable.h"

PM_C_BEGIN

struct pm_field;
struct pm_multigrid_choice {
	struct pm_mg_choice cycle;
	int order;            /* of the differences, 2 or 4 */
	bool variable;        /* with a permittivity */
	bool galerkin;        /* coarse matrices P^T A P, with or without one */
	enum pm_mg_mean mean; /* of it on the faces between nodes */
	const struct pm_field *field; /* whose planes are solved for, where ranks share the mesh; NULL: all are here */
};

struct pm_multigrid; /* a few solvers, for the grids of the components of a vector */

struct pm_multigrid *pm_multigrid_new(void);
struct pm_multigrid *pm_multigrid_free(struct pm_multigrid *m);
/* Fills in defaults for smoother (NULL) and relaxation (NAN), returns 0; or a failure if the options do not fit together. */
int pm_multigrid_choose(struct pm_multigrid_choice *o, const char *smoother, double relaxation);
/* 0, or a failure that names a method that can. */
int pm_multigrid_check(const struct pm_multigrid_choice *o, const struct pm_grid *g);
/* Makes the hierarchy that pm_multigrid_solve would make; for measuring its cost. */
int pm_multigrid_prepare(struct pm_multigrid *m, const struct pm_multigrid_choice *o, const struct pm_grid *g, const double *eps);
/* As pm_mg_solve; eps NULL: 1; where ranks share the mesh it has a plane of the neighbours on either side, here as in pm_multigrid_prepare. */
int pm_multigrid_solve(struct pm_multigrid *m, const struct pm_multigrid_choice *o, const struct pm_grid *g, const double *eps, double c, const double *s,
	double *phi,
	struct pm_mg_record *r);

PM_C_END

#endif
