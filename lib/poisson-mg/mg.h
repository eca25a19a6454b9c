/* Multigrid for lap phi = f on the nodes of a mesh (mg.c; docs/methods/poisson-mg.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_MG_MG_H
#define PM_POISSON_MG_MG_H

#include "mesh/grid.h"

PM_C_BEGIN

enum pm_mg_cycle { PM_MG_V, PM_MG_W, PM_MG_FMG }; /* V or W cycles from zero; full multigrid, then V-cycles */
enum pm_mg_smoother { PM_MG_RED_BLACK, PM_MG_SOR, PM_MG_JACOBI, PM_MG_FOUR_COLOUR }; /* SOR: red-black, over-relaxed */
extern const char *const pm_mg_smoother_names[]; /* NULL ends */
enum { PM_MG_MOST = 1000 };

struct pm_mg_choice {
	int pre, post;        /* sweeps before and after the coarse grid */
	enum pm_mg_smoother smoother;
	bool half_weighting;  /* of the residual, for comparison: worse than full weighting in every reference */
	enum pm_mg_cycle cycle;
	bool plain;           /* with Galerkin matrices: cycles alone, without conjugate gradients around them */
	double relaxation;    /* factor omega of the sweeps, 1: Gauss-Seidel; pm_mg_relaxation returns good ones */
	double tolerance;     /* of the residual, relative to the right-hand side, root of the sum of squares */
	int most;             /* cycles, up to PM_MG_MOST */
	const double *known;  /* order 4: what known boundary values add to the differences, points of the grid (poisson/boundary.h); NULL: none */
};

struct pm_mg_record {
	int cycles;           /* whole ones; the pre-smoothing in which the end was noticed is not counted */
	double before, after; /* relative residual at the first test and at the last */
	double contraction;   /* of the residual per cycle, geometric mean over the cycles above round-off; 0 if there was none */
	double mean;          /* removed from c*s, as a mean of s; 0 if the problem is not singular */
	double incompatible;  /* |mean| over the largest |s|: round-off where the data fit the faces */
	bool singular, converged;
	bool floor;           /* round-off keeps the residual above the tolerance; counts as converged */
	int n;                /* entries of history: relative residual after 0, 1, ... cycles */
	double history[PM_MG_MOST + 1];
};

struct pm_mg; /* the hierarchy of grids, for one pm_grid */

/* 0, or a failure that names what can: faces open and absorbing are refused. */
int pm_mg_check(const struct pm_grid *g);
double pm_mg_relaxation(enum pm_mg_smoother smoother, int dim, int order); /* defaults: 1; 1.15 for SOR; 2/3, 4/5, 6/7 for Jacobi, less at order 4 */
/* Faces periodic, wall (phi = 0) or neumann (no normal gradient), in any mixture; order 2 or 4 (Mehrstellen). NULL with a message. */
struct pm_mg *pm_mg_new(const struct pm_grid *g, int order);
struct pm_mg *pm_mg_free(struct pm_mg *mg);
bool pm_mg_fits(const struct pm_mg *mg, const struct pm_grid *g, int order); /* was it made for this grid? */
int pm_mg_levels(const struct pm_mg *mg);

/* lap phi = c*s; s and phi have the points of the grid and may be the same array. Singular problems: the mean of s is removed and that of phi
 * is zero. 0, or -PM_NUMERICS where the tolerance is not reached; the record is filled in any case. */
int pm_mg_solve(struct pm_mg *mg, const struct pm_mg_choice *o, double c, const double *s, double *phi, struct pm_mg_record *r);

/* The failure, with the history; transforms: could poisson-fft solve it? */
int pm_mg_not_converged(const struct pm_mg_record *r, const struct pm_mg_choice *o, bool transforms);

/* For studies of convergence: f and u set by hand, one cycle (V or W), the root of the mean square of f - lap u, u copied out. */
void pm_mg_start(struct pm_mg *mg, const double *f, const double *u);
void pm_mg_once(struct pm_mg *mg, const struct pm_mg_choice *o);
double pm_mg_residual(const struct pm_mg *mg);
void pm_mg_values(const struct pm_mg *mg, double *u);

PM_C_END

#endif
