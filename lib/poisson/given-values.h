/* Boundary values that the user gives: expressions for faces, or sums over the particles on open faces; from options to numbers on the nodes of the faces.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_GIVEN_VALUES_H
#define PM_POISSON_GIVEN_VALUES_H

#include "expression/expression.h"
#include "law/law.h"
#include "poisson/boundary.h"

struct pm_given_names { /* options; NULL: not given */
	const char *dirichlet;  /* phi on every wall and open face */
	const char *flux;       /* d phi/dn outward on every neumann face */
	const char *face[3][2]; /* on this face alone: phi, or at a neumann face d phi/dn */
	const char *open;       /* free, sum */
};
extern const char *const pm_given_open_names[]; /* NULL ends */

struct pm_given_values {
	bool any, sum;          /* some face has values; those of open faces are sums over the particles */
	bool opened;            /* an open face became a wall with other values than these sums */
	bool inside[3][2];      /* a wall or neumann face of the box has values that are not 0, so images there are wrong */
	const char *text[3][2];
	struct pm_expression e[3][2];
};

/* Header: which faces have values; open ones that have become walls in g. 0, or a failure that says which face cannot. */
int pm_given_find(const struct pm_given_names *o, const struct pm_frame *f, const struct pm_law *law, struct pm_grid *g, struct pm_given_values *v);
/* Header: compiles the expressions on the mesh, for a target of so many components; reads what the sums need, of the sets in the density. */
int pm_given_declare(struct pm_given_values *v, struct pm_frame *f, const char *mesh, const struct pm_law *law, const struct pm_field *density);
/* Data: the values of component c. b->grid is set; 0, or failure where a value is not finite. */
int pm_given_evaluate(const struct pm_given_values *v, const struct pm_frame *f, const struct pm_law *law, const struct pm_field *density, int c,
	double coefficient, struct pm_boundary *b);

#endif
