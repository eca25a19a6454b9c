/* Known values on the faces of a mesh: phi at walls (Dirichlet), its outward normal derivative at neumann faces. What they add to the differences of a solver
 * is known, so it moves to the right-hand side, and the solver solves the homogeneous problem (boundary.c). One component. Where ranks share the mesh, each has
 * the values on all faces (a surface, not a volume); what is of the points of the grid has its own planes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_BOUNDARY_H
#define PM_POISSON_BOUNDARY_H

#include "mesh/planes.h"

enum { PM_BOUNDARY_ALL = 63 };
struct pm_boundary {
	struct pm_grid grid;
	const struct pm_planes *planes; /* NULL: all points are here */
	double *value[3][2]; /* points of the face, the lower of its axes fastest: phi, or d phi/dn outward [phi/length]; NULL: 0 */
};

struct pm_boundary_eps { /* of div(eps grad phi); NULL for a coefficient of 1 */
	const double *eps;                     /* points of the grid, where ranks share it with a plane more on either side */
	double (*between)(double a, double b); /* eps half-way between two nodes */
};

size_t pm_boundary_points(const struct pm_grid *g, int d); /* of a face of axis d */
/* Room for the values of a face; 0 or failure. */
int pm_boundary_room(struct pm_boundary *b, int d, int side);
/* From the nodes of a face that are in the planes here to all of the face, of which `value` has room for all: without other ranks nothing is to be done. Takes
 * the caller's status and returns the agreed one (world/world.h). */
int pm_boundary_share(int status, const struct pm_boundary *b, int d, int side, double *value);
/* The nodes of a face that are here: points *from <= i < *to of it; and the place of point i among the points here. */
void pm_boundary_here(const struct pm_boundary *b, int d, int side, size_t *from, size_t *to);
size_t pm_boundary_node(const struct pm_boundary *b, int d, int side, size_t i);
void pm_boundary_free(struct pm_boundary *b);

/* known, points of the grid: the differences of order 2, or the compact ones of order 4, of a function that has the known values and is 0 at every unknown
 * node; 0 on walls. `faces`: bits 2 axis + side of those that count. eps: order 2 alone. */
void pm_boundary_known(const struct pm_boundary *b, int order, unsigned faces, const struct pm_boundary_eps *eps, double *known);
/* phi on the walls; where walls meet, the mean of theirs. */
void pm_boundary_set(const struct pm_boundary *b, double *phi);
/* The integral of eps d phi/dn over all neumann faces and of its absolute value, by trapezoids. Takes the caller's status and returns the agreed one. */
struct pm_boundary_flux {
	double total, absolute;
};
int pm_boundary_flux(int status, const struct pm_boundary *b, const struct pm_boundary_eps *eps, struct pm_boundary_flux *flux);

#endif
