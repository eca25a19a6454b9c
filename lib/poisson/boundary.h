/* Known values on the faces of a mesh: phi at walls (Dirichlet), its outward normal derivative at neumann faces. What they add to the differences of a solver
 * is known, so it moves to the right-hand side, and the solver solves the homogeneous problem (boundary.c). One component.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_BOUNDARY_H
#define PM_POISSON_BOUNDARY_H

#include "mesh/grid.h"

enum { PM_BOUNDARY_ALL = 63 };
struct pm_boundary {
	struct pm_grid grid;
	double *value[3][2]; /* points of the face, the lower of its axes fastest: phi, or d phi/dn outward [phi/length]; NULL: 0 */
};

struct pm_boundary_eps { /* of div(eps grad phi); NULL for a coefficient of 1 */
	const double *eps;                     /* points of the grid */
	double (*between)(double a, double b); /* eps half-way between two nodes */
};

size_t pm_boundary_points(const struct pm_grid *g, int d); /* of a face of axis d */
/* Room for the values of a face; 0 or failure. */
int pm_boundary_room(struct pm_boundary *b, int d, int side);
void pm_boundary_free(struct pm_boundary *b);

/* known, points of the grid: the differences of order 2, or the compact ones of order 4, of a function that has the known values and is 0 at every unknown
 * node; 0 on walls. `faces`: bits 2 axis + side of those that count. eps: order 2 alone. */
void pm_boundary_known(const struct pm_boundary *b, int order, unsigned faces, const struct pm_boundary_eps *eps, double *known);
/* phi on the walls; where walls meet, the mean of theirs. */
void pm_boundary_set(const struct pm_boundary *b, double *phi);
/* The integral of eps d phi/dn over all neumann faces and of its absolute value, by trapezoids. */
struct pm_boundary_flux {
	double total, absolute;
};
struct pm_boundary_flux pm_boundary_flux(const struct pm_boundary *b, const struct pm_boundary_eps *eps);

#endif
