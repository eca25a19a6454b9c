/* The problem a solver is given in a frame: lap target = c * source on a mesh, named by the law or by the user. The same for every solver, so that solvers
 * are interchangeable. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_PROBLEM_H
#define PM_POISSON_PROBLEM_H

#include "poisson/given-values.h"

/* Which components of a vector are zero at a wall; the others have no normal gradient there, at a neumann face it is the other way round.
 * tangential: E at a conductor, the vector potential of a flow along the wall; normal: a flow along the wall; all: each component is a scalar. */
enum pm_wall_rule { PM_ZERO_TANGENTIAL, PM_ZERO_NORMAL, PM_ZERO_ALL };
extern const char *const pm_wall_rule_names[]; /* NULL ends */

struct pm_problem_names { /* NULL and NAN: the law's */
	const char *source, *target, *mesh, *wall;
	double coefficient;
	struct pm_given_names given;
};

struct pm_problem {
	const struct pm_law *law;
	const struct pm_mesh *mesh;
	const char *source_name, *target_name;
	struct pm_grid grid;     /* with the faces of a scalar; open ones that were given values are walls */
	bool open;               /* some face of the box is open */
	enum pm_wall_rule wall;
	double c;
	bool keep;               /* set before pm_problem_declare: a target that is there is changed, not made anew */
	bool own;                /* the coefficient is not the law's */
	const struct pm_field *source; /* after pm_problem_declare */
	struct pm_field *target;
	struct pm_given_values given;
};

/* The problem with homogeneous faces that a solver is given: lap u = c s. */
struct pm_homogeneous {
	double c;
	const double *s;
	const double *known;  /* of compact differences of order 4, which the solver subtracts behind its own treatment of s; else NULL */
	double charge, charge_absolute; /* the integral of the law's c s and its absolute value, if values are given */
	struct pm_boundary_flux flux;
	struct pm_planes planes; /* of the source */
	struct pm_boundary boundary;
	double *source, *moved;
};

int pm_problem_find(const struct pm_frame *f, const struct pm_problem_names *names, struct pm_problem *p);
int pm_problem_declare(struct pm_frame *f, struct pm_problem *p); /* reads the source, makes the target: derived, with the source's kernel */
void pm_problem_not_of_law(struct pm_problem *p); /* the target is not the law's potential of the particles, so m2p does not know it beyond the mesh */
/* A coefficient beside the source: one component on the nodes of the same mesh; read. */
int pm_problem_coefficient(struct pm_frame *f, const struct pm_problem *p, const char *name, const struct pm_field **field);
/* Its values, those of the planes here; where ranks share the mesh, with a plane of the neighbours on either side: *room is to be freed with pm_free. 0 or
 * failure, which the ranks agree on. */
int pm_problem_coefficient_values(const struct pm_problem *p, const struct pm_field *field, const double **values, double **room);
/* Data: component c with its boundary values moved to the right-hand side, for differences of order 2 or 4; 0: not moved, boundary has them; eps NULL: 1.
 * Where no values are given, c and s are the problem's own. pm_homogeneous_close writes the values onto the walls of phi; free in any case. 0 or failure,
 * which the ranks agree on. */
int pm_problem_move(const struct pm_problem *p, const struct pm_frame *f, int c, int order, const struct pm_boundary_eps *eps, struct pm_homogeneous *m);
void pm_homogeneous_close(struct pm_homogeneous *m, double *phi);
void pm_homogeneous_free(struct pm_homogeneous *m);
struct pm_grid pm_problem_grid(const struct pm_problem *p, int c); /* after pm_problem_declare: with the faces of component c */

#endif
