/* A multigrid hierarchy and what is done on it, file by file; private to lib/poisson-mg. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_MG_MG_HIERARCHY_H
#define PM_POISSON_MG_MG_HIERARCHY_H

#include "poisson-mg/mg-level.h"
#include "base/in-order.h"
#include "poisson-mg/mg.h"

enum { mg_levels_most = 96 };

struct pm_mg {
	struct pm_grid grid;
	int levels, threads, order;
	struct mg_level level[mg_levels_most];
	mg_number *scratch;    /* per thread: four rows */
	size_t room;           /* of scratch per thread, a multiple of mg_lanes */
	double *sums;          /* per plane of the finest grid */
	int shared;            /* grids 0 .. shared-1 are in planes on all ranks; the next one is too, to hand over to `whole`; 0: alone */
	struct pm_mg *whole;   /* rank 0: that one and the coarser grids */
	int status;            /* agreed by all ranks since the solution began */
	struct pm_mg_single *single; /* for its corrections (mg-refine.c); NULL: not made yet, or this is one */
};

/* The sum of one number per plane, n of them; of a plane the rows are added first (base/in-order.h). */
static inline double pm_mg_planes(size_t n, const double *sums) { return pm_sum_of_rows((const size_t[3]){1, 1, n}, sums); }

/* What a sweep does with a plane, in this order. */
enum mg_stage { MG_ZERO, MG_CORRECT, MG_INTERPOLATE, MG_RED, MG_BLACK, MG_JACOBI, MG_KEEP, MG_COLOUR }; /* MG_COLOUR + 0 .. 3 */
enum { mg_stages_most = 4 * 32 + 1 };

/* mg-relax.c */
void pm_mg_relax_plain(const struct mg_level *l, double relaxation, int colour, size_t k); /* the same bytes, a node at a time */
void pm_mg_relax_plane(const struct mg_level *l, double relaxation, int colour, size_t k);
double pm_mg_residual_row(const struct mg_level *l, size_t j, size_t k, mg_number *r); /* as a row, closed behind its end; returns the sum of squares */
struct mg_rows { /* of u and f, and the neighbours of that of u along y and z */
	mg_number *u;
	const mg_number *f, *south, *north, *back, *front;
};
double pm_mg_residual_of(const struct mg_level *l, struct mg_rows a, mg_number *r); /* order 2: the same of rows that are anywhere */

/* mg-compact.c */
void pm_mg_compact_init(struct mg_level *l); /* the weights, also those of order 2 */
void pm_mg_colour_plane(const struct mg_level *l, double relaxation, int colour, size_t k, mg_number *w); /* w: room for a row */
void pm_mg_jacobi_plane(const struct mg_level *l, double relaxation, size_t k, mg_number *w); /* v from u */
void pm_mg_keep_plane(const struct mg_level *l, size_t k);                                  /* u from v */
double pm_mg_compact_residual(const struct mg_level *l, size_t j, size_t k, mg_number *r);  /* as pm_mg_residual_row */
/* The right-hand side of order 4 for lap u = s; on planes of a grid l,
 * of which s has two more on either side where they are not all. */
void pm_mg_compact_source(const struct pm_grid *g, const struct mg_level *l, const double *s, double *out);

/* mg-transfer.c */
struct mg_parents { /* of one node along one axis, without those of weight 0 */
	int n;
	size_t node[mg_cubic];
	double w[mg_cubic];
};
void pm_mg_add_row(size_t n, double w, const mg_number *restrict x, mg_number *restrict y); /* y += w x; n a multiple of mg_lanes */
void pm_mg_fold_row(const struct mg_level *l, const mg_number *restrict t, mg_number *restrict row); /* from node after node to a row */
/* A combination of coarse rows, node after node in t, closed at its ends if periodic: t[-1] ... t[n+1]. */
void pm_mg_gather(const struct mg_level *c, const struct mg_parents *y, const struct mg_parents *z, mg_number *t);
void pm_mg_correct_plane(const struct mg_level *fine, const struct mg_level *coarse, size_t k, mg_number *w);
double pm_mg_restrict(struct pm_mg *mg, int fine, bool half_weighting); /* of f - lap u; returns its sum of squares on the finest grid */

/* mg-pyramid.c */
bool pm_mg_pyramid(struct pm_mg *mg, double factor, const double *s); /* order 4: f of every grid but the finest from the source s itself; false: no memory */

/* mg-full.c */
/* Lagrange weights of up to four nodes of an axis around x [cells]; below = floor(x). */
void pm_mg_lagrange(const struct mg_axis *a, ptrdiff_t below, double x, size_t *node, double *w);
bool pm_mg_full_tables(const struct mg_axis *fine, const struct mg_axis *coarse, struct mg_map *map);
void pm_mg_interpolate_plane(const struct mg_level *fine, const struct mg_level *coarse, size_t k, mg_number *w);
void pm_mg_restrict_source(struct pm_mg *mg, int fine);

/* mg-sweep.c */
void pm_mg_sweep(struct pm_mg *mg, int level, double relaxation, int n, const enum mg_stage *stages);

/* mg.c */
/* As pm_mg_solve, for a source that is already that of the differences; point: the source before it was made compact, NULL where there is none. */
int pm_mg_solve_differences(struct pm_mg *mg, const struct pm_mg_choice *o, double c, const double *s, const double *point, double *phi,
	struct pm_mg_record *r);

/* mg-load.c */
double pm_mg_mean(struct pm_mg *mg, const double *values);                             /* with the weights of quadrature */
double pm_mg_largest(size_t n, double c, double average, const double *s);             /* |c (s - average)| */
void pm_mg_clear(struct pm_mg *mg);                                                    /* u of the finest grid = 0 */
/* f of the hierarchy and of the single one, or one of them; its sum of squares and the largest of its values. */
enum mg_load { MG_LOAD_OWN = 1, MG_LOAD_SINGLE = 2 };
double pm_mg_load(struct pm_mg *mg, double c, double average, const double *s, int to, double *largest);
double pm_mg_load_row(const struct mg_level *l, double c, double average, const double *s, double *f, double *largest);
void pm_mg_store(const struct pm_mg *mg, double factor, double average, double *phi);
void pm_mg_store_row(const struct mg_level *l, double factor, double average, const double *u, double *to);

/* mg-refine.c: cycles in single numbers, residuals in double ones. Is that for this problem? Their right-hand side in row j of plane k is scale r. And the
 * solution from f, of both hierarchies, whatever u is: false where it stalls, to be continued in double numbers. */
bool pm_mg_refines(struct pm_mg *mg, const struct pm_mg_choice *o);
void pm_mg_refine_source(struct pm_mg *mg, double scale, size_t j, size_t k, const double *r);
struct mg_once {       /* where one round is expected to do: */
	double c, unit;        /* f = c/unit s was loaded into the single hierarchy alone */
	const double *s;
	double *phi;           /* for unit times the solution */
	bool stored;           /* it is there */
};
bool pm_mg_refine(struct pm_mg *mg, const struct pm_mg_choice *o, double source, struct mg_once *once, struct pm_mg_record *r); /* once may be NULL */
bool pm_mg_refines_once(const struct pm_mg *mg, const struct pm_mg_choice *o);
bool pm_mg_at_roundoff(struct pm_mg *mg, double residual, double source); /* mg.c */

/* mg-cycle.c */
size_t pm_mg_unknowns(const struct mg_level *l);
double pm_mg_squares(struct pm_mg *mg, const mg_number *values); /* their sum over the unknowns of u or f of the finest grid */
void pm_mg_solve_coarsest(struct pm_mg *mg); /* one unknown, or none, or a constant that may be anything */
double pm_mg_cycle_down(struct pm_mg *mg, int at, const struct pm_mg_choice *o, bool zero); /* relax, restrict; sum of squares of the residual, finest grid */
void pm_mg_cycle_up(struct pm_mg *mg, int at, const struct pm_mg_choice *o);                /* the coarser grids, correct, relax */
void pm_mg_start_sources(struct pm_mg *mg); /* the right-hand sides of all grids from the finest, for full multigrid */
void pm_mg_start_full(struct pm_mg *mg, const struct pm_mg_choice *o); /* then from the coarsest grid up, one cycle on each but the finest */

/* mg-hierarchy.c */
bool pm_mg_build(struct pm_mg *mg, const struct pm_grid *g, int order, const struct pm_planes *planes);
bool pm_mg_room(struct pm_mg *mg, const struct pm_mg_choice *o); /* for what the smoother needs */
void pm_mg_demolish(struct pm_mg *mg);

#endif
