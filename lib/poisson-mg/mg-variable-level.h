/* The grids and matrices of multigrid with a variable coefficient; private to lib/poisson-mg/mg-variable*.c.
 * Only unknowns are stored, with a layer of ghosts around them along each axis below dim: copies on a periodic axis, zeros elsewhere, where the
 * weights that would multiply them are zero too. Axes are x, y, z. Ranks have planes of every grid along the last axis, a coarse one where the fine one at or
 * below it is, and those of their neighbours as ghosts: one to relax, two for Galerkin matrices. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_MG_MG_VARIABLE_LEVEL_H
#define PM_POISSON_MG_MG_VARIABLE_LEVEL_H

#include "mesh/planes.h"
#include "poisson-mg/mg-variable.h"

enum { mgv_neighbours = 27, mgv_parents = 8, mgv_levels = 64, mgv_parallel = 65536 };

struct mgv_level {
	int dim;
	size_t m[3];          /* unknowns per axis on this rank, */
	size_t all[3], begin[3]; /* those of the mesh, and how many of them lie before the ones here */
	uint64_t *from;       /* the first plane of every rank, one more than ranks; NULL: all are here */
	int beyond;           /* layers of ghosts along the last axis; 1 along the others */
	int *status;          /* agreed by all ranks; of the hierarchy */
	bool periodic[3];
	double h[3];          /* [length] */
	size_t stride[3], size; /* of the padded arrays */
	size_t origin;        /* place of unknown 0, 0, 0 */
	int n;                /* neighbours of a node with itself, which is number 0 */
	int shift[mgv_neighbours][3];
	ptrdiff_t at[mgv_neighbours];
	double *w[mgv_neighbours]; /* the matrix -div eps grad, times a half for each neumann face a node is on, so that it is symmetric */
	double *rest;         /* finest grid: the sum of the weights of a node, those of walls; then M u is summed from differences, which cancel less */
	double *u, *f, *r;    /* M u = f; r: the residual */
	bool halved[3];       /* is the axis coarsened from here? */
	size_t start[3];      /* then its first coarse node */
	double *p[mgv_parents]; /* weights of the parents: bit d set: the one above along axis d, clear: the one below, or the node itself where it is coarse */
};

struct pm_mg_variable {
	struct pm_grid grid;
	struct pm_planes planes;
	int status;           /* agreed by all ranks since the last solution began */
	enum pm_mg_mean mean;
	double *eps;          /* as given, with a plane more on either side where ranks share the mesh */
	bool constant;        /* none was: eps is 1 */
	int levels;
	bool fixed;           /* at least one wall */
	struct mgv_level level[mgv_levels]; /* the coarsest has one unknown */
	double *x, *d, *q, *before, *best; /* solution, direction, M d, residual of the iteration before, the x of least residual; padded as the finest level */
	double *sums;         /* per row of the finest level */
};

static inline size_t mgv_total(const struct mgv_level *l) { return l->all[0] * l->all[1] * l->all[2]; } /* unknowns of all ranks */
/* The unknown of the mesh that begins a row here. */
static inline void mgv_at(const struct mgv_level *l, size_t row, size_t at[3])
{
	at[0] = 0, at[1] = row % l->m[1] + l->begin[1], at[2] = row / l->m[1] + l->begin[2];
}
static inline size_t mgv_rows(const struct mgv_level *l) { return l->m[1] * l->m[2]; }
static inline size_t mgv_row(const struct mgv_level *l, size_t row) { return l->origin + (row % l->m[1]) * l->stride[1] + (row / l->m[1]) * l->stride[2]; }
static inline size_t mgv_unknowns(const struct mgv_level *l) { return l->m[0] * mgv_rows(l); }

/* mg-variable-level.c */
bool pm_mgv_alloc(struct mgv_level *l, bool star); /* arrays and offsets, from dim, all, from, periodic and h; star: only the neighbours along the axes */
void pm_mgv_free(struct mgv_level *l);
void pm_mgv_ghosts(const struct mgv_level *l, double *a);
void pm_mgv_ghosts_wide(const struct mgv_level *l, double *a, int wide); /* so many planes of other ranks */
int pm_mgv_finest(struct pm_mg_variable *v); /* level 0 and its matrix */
void pm_mgv_load(const struct pm_mg_variable *v, double c, double average, const double *s, double *f); /* the right-hand side */
void pm_mgv_store(const struct pm_mg_variable *v, double factor, const double *u, double *phi);

/* mg-variable-coarse.c */
bool pm_mgv_coarser(struct mgv_level *fine, struct mgv_level *coarse, bool *more); /* the next grid, transfers and Galerkin matrix; *more: there is one */

/* mg-variable-cycle.c */
void pm_mgv_residual(const struct mgv_level *l, const double *u, const double *f, double *r); /* f - M u; ghosts of u are filled */
void pm_mgv_cycle(struct pm_mg_variable *v, int at, const struct pm_mg_choice *o, bool zero); /* on u and f of a level; zero: from u = 0 */
void pm_mgv_full(struct pm_mg_variable *v, const struct pm_mg_choice *o); /* u of level 0 from its f, by full multigrid */

#endif
