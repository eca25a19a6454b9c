/* The parts of James' method; of lib/poisson-mg/mg-open*.c and lib/james/james.c. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_MG_MG_OPEN_PARTS_H
#define PM_POISSON_MG_MG_OPEN_PARTS_H

#include "poisson-mg/mg-hierarchy.h"
#include "poisson-mg/mg-open.h"

/* The differences A as a list. */
struct mg_stencil {
	int n;
	int shift[27][3];
	double w[27];
};

/* mg-open-kernel.c */
struct mg_stencil pm_mg_stencil(const struct pm_grid *g, int order);
/* f -= A of the values on the walls and beyond neumann faces, on the nodes beside them. */
void pm_mg_lift(const struct pm_grid *g, const struct mg_stencil *a, const double *walls, double *f);
/* The solution of A G = 1 on one node of the infinite lattice, 0 on all others, at the offsets 0 .. cells of each axis. 0 or a failure. */
int pm_mg_lattice(const struct pm_grid *g, int order, double *table);

/* mg-open-faces.c */
struct mg_faces; /* a convolution from the surface of a box to itself */
struct mg_faces *pm_mg_faces_new(const struct pm_grid *g, const double *table);
struct mg_faces *pm_mg_faces_free(struct mg_faces *s);
/* out -= G * charge on the nodes of the surface, which start from zero; charge is zero elsewhere. 0 or a failure. */
int pm_mg_faces_apply(const struct mg_faces *s, const double *charge, double *out);

#endif
