/* The driver of the iterative methods of lib/relax: lap phi = c*s on the nodes of a mesh (relaxation.c; docs/methods/poisson-relax.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_RELAX_RELAXATION_H
#define PM_POISSON_RELAX_RELAXATION_H

#include "relax/relax.h"

enum { PM_RELAXATION_MARKS = 40 };

struct pm_relaxation_choice {
	const struct pm_relax *method;
	double factor;        /* of relaxation; NAN: the method's own */
	double tolerance;     /* of the residual, relative to the right-hand side, root of the mean square */
	int64_t most;         /* sweeps */
	bool exactly;         /* just as many, whatever the residual */
	const double *start;  /* phi to begin with, points of the grid; NULL: 0. Not with open faces */
};

struct pm_relaxation_record {
	int64_t sweeps;
	double factor;        /* used; NAN: the method has none */
	double after;         /* relative residual at the end */
	double radius;        /* residual per sweep, geometric mean over the last half of the sweeps or more; NAN where there were fewer than 4 */
	double expected;      /* by the formula of the method; NAN: none holds here */
	double mean;          /* removed from c*s, as a mean of s; 0 if the problem is not singular */
	double incompatible;  /* |mean| over the largest |s|: round-off where the data fit the faces */
	bool singular, converged;
	bool floor;           /* round-off keeps the residual above the tolerance; counts as converged */
	int n;                /* relative residuals after sweep[i] = 1, 2, 4, 8 ... */
	int64_t sweep[PM_RELAXATION_MARKS];
	double history[PM_RELAXATION_MARKS];
};

struct pm_relaxation; /* the meshes of a method, for one pm_grid */

/* 0, or a failure that names what can: faces absorbing or open on some axes only, and a method or factor whose error would not shrink. */
int pm_relaxation_check(const struct pm_grid *g, const struct pm_relax *method, double factor);
bool pm_relaxation_open(const struct pm_grid *g); /* is any face open? */
struct pm_relaxation *pm_relaxation_new(const struct pm_grid *g, const struct pm_relax *method); /* NULL with a message */
/* The same on the planes of a field that ranks share (NULL: all): s, start and phi are then those, and all ranks solve together. */
struct pm_relaxation *pm_relaxation_new_of(const struct pm_grid *g, const struct pm_relax *method, const struct pm_field *field);
bool pm_relaxation_same_planes(const struct pm_relaxation *p, const struct pm_field *field);
bool pm_relaxation_shares(const struct pm_grid *g, const struct pm_relax *method); /* can ranks? */
struct pm_relaxation *pm_relaxation_free(struct pm_relaxation *p);
bool pm_relaxation_fits(const struct pm_relaxation *p, const struct pm_grid *g, const struct pm_relax *method);

/* lap phi = c*s from phi = 0 or from start; s and phi have the points of the grid and may be the same array. Singular problems: the mean of s
 * is removed and that of phi is zero. 0, or -PM_NUMERICS where the tolerance is not reached; the record is filled in any case. */
int pm_relaxation_solve(struct pm_relaxation *p, const struct pm_relaxation_choice *o, double c, const double *s, double *phi,
	struct pm_relaxation_record *r);

/* For studies of convergence: f and u by hand; w->u is the iterate, w->lap the operator. */
struct pm_relax_work *pm_relaxation_work(struct pm_relaxation *p);
void pm_relaxation_start(struct pm_relaxation *p, double factor, const double *f, const double *u);

#endif
