/* The parts of James' method; of lib/poisson-mg/mg-open*.c and lib/james/james.c. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_MG_MG_OPEN_PARTS_H
#define PM_POISSON_MG_MG_OPEN_PARTS_H

#include "poisson/boundary.h"
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
/* The solution of A G = 1 on one node of the infinite lattice, 0 on all others, at the offsets 0 .. cells of each axis. NULL with a message. */
struct mg_lattice;
struct mg_lattice *pm_mg_lattice_new(const struct pm_grid *g, int order);
struct mg_lattice *pm_mg_lattice_free(struct mg_lattice *l);
double pm_mg_lattice_value(const struct mg_lattice *l, const size_t at[3]);
int pm_mg_lattice(const struct pm_grid *g, int order, double *table); /* all of them; 0 or a failure */

/* mg-open-faces.c */
struct mg_faces; /* a convolution from the surface of a box to itself */
/* planes: NULL, or those of a rank: then all ranks call each of the two together, and have all values of the surface. NULL with a message. */
struct mg_faces *pm_mg_faces_new(const struct pm_grid *g, int order, const struct pm_planes *planes);
struct mg_faces *pm_mg_faces_free(struct mg_faces *s);
/* out = -G * charge on the nodes of the surface; of both there is room on every face. Takes the caller's status and returns the agreed one. */
int pm_mg_faces_apply(int status, const struct mg_faces *s, const struct pm_boundary *charge, struct pm_boundary *out);

/* mg-open-walls.c: from the solution between grounded walls to that in free space, on the planes of a rank or all of them (NULL). */
struct mg_walls;
struct mg_walls *pm_mg_walls_new(const struct pm_grid *g, int order, const struct pm_planes *planes); /* NULL with a message */
struct mg_walls *pm_mg_walls_free(struct mg_walls *o);
const struct pm_planes *pm_mg_walls_planes(const struct mg_walls *o); /* a copy of those */
struct pm_grid pm_mg_walled(const struct pm_grid *g); /* the box, grounded */
/* u: the solution of A u = f, 0 on the walls. f becomes the source between walls of phi less its boundary values; room: of as many numbers. Takes the caller's
 * status and returns the agreed one. Then the values, on the walls of phi. */
int pm_mg_walls_source(int status, struct mg_walls *o, const double *u, double *f, double *room);
void pm_mg_walls_set(const struct mg_walls *o, double *phi);

#endif
