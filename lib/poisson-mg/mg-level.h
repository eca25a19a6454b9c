/* A grid of a multigrid hierarchy; private to lib/poisson-mg.
 * Axes are those of memory: axis 0 is x; a 2-D mesh has its y as axis 2, so that axis 2 always counts the planes divided among threads.
 * A row holds its even nodes first, then its odd ones (mg_slot): the nodes of one colour are one half of a row, all their neighbours along x are the other
 * half of it, and their neighbours along y and z lie at the same place of the same half of other rows. Each half is padded to whole vectors of
 * mg_lanes values and one more. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_MG_MG_LEVEL_H
#define PM_POISSON_MG_MG_LEVEL_H

#include "mesh/planes.h"
#include "poisson-mg/mg-number.h"
#include "mesh/index-fold.h"

enum { mg_cubic = 4, mg_parallel = 131072, mg_beyond = 3 }; /* values below which a grid is not worth the barriers of threads */

struct mg_axis {
	size_t cells, points;  /* 1 cell, 1 point, w = 0: an axis on which nothing varies */
	size_t first, end;     /* unknowns first <= i < end; wall nodes are left out and stay 0 */
	bool periodic, neumann[2];
	double length, h, w;   /* [length]; w = 1/h^2 */
};

/* From an axis of a grid to the same axis of the next coarser one. Node i has parents parent[i] and parent[i]+1 (before folding a periodic
 * axis; -1 and n_c occur) with linear weights w; a = w W_i/W_parent with the quadrature weights W, so that restriction keeps sums. */
struct mg_map {
	bool same, half;       /* not coarsened; every second node */
	ptrdiff_t *parent;
	double *w[2], *a[2];
	size_t *four[2];       /* of mg-full.c: to start full multigrid: mg_cubic parents per node, folded, */
	double *cubic[2];      /* and their weights in [0] interpolation, [1] restriction of the right-hand side */
};

struct mg_level {
	int dim;               /* 1: x; 2: x and planes; 3: all */
	int order;             /* of the differences: 2 or 4 */
	struct mg_axis axis[3];
	size_t half, stride, plane; /* of half a row, of a row, of a plane */
	double diagonal;       /* 2 (wx + wy + wz); order 4: less, see mg-compact.c */
	double side[3], cross[3]; /* order 4: weights of the neighbours along x, y, z and across the corners in xy, xz, yz */
	bool fixed;            /* at least one wall: not singular */
	size_t first, here;    /* planes of this rank: alone all */
	uint64_t *from;        /* the first plane of every rank, one more than ranks; NULL: all are here */
	size_t *at;            /* [values] where a plane is, own ones and mg_beyond of other ranks below and above; NULL: one behind the other */
	bool beside;           /* f of the planes of other ranks is up to date */
	mg_number *u, *f, *v;     /* v: room for Jacobi's sweeps, if there were any */
	mg_mask *mask[2];      /* per half: -1 for an unknown, else 0 */
	struct mg_map map[3];  /* to the next level; not filled on the coarsest */
};

static inline size_t mg_whole(size_t n) { return (n + mg_lanes - 1) / mg_lanes * mg_lanes; } /* with its padding */
static inline size_t mg_slot(const struct mg_level *l, size_t i) { return (i & 1) * l->half + i / 2; } /* of node i in its row */

static inline size_t mg_fold(ptrdiff_t i, const struct mg_axis *a) { return pm_index_fold(i, a->points, a->periodic); }
static inline size_t mg_below(const struct mg_axis *a, size_t i) { return pm_index_below(i, a->points, a->periodic); }
static inline size_t mg_above(const struct mg_axis *a, size_t i) { return pm_index_above(i, a->points, a->periodic); }
static inline size_t mg_size(const struct mg_level *l) { return l->axis[2].points * l->plane; }
/* Values on this rank. */
static inline size_t mg_held(const struct mg_level *l) { return l->from ? (l->here + 2 * mg_beyond) * l->plane : mg_size(l); }
static inline size_t mg_plane(const struct mg_level *l, size_t k) { return l->at ? l->at[k] : k * l->plane; }
static inline size_t mg_own(const struct mg_level *l) { return l->from ? mg_beyond * l->plane : 0; } /* where the first own plane is */
/* The unknown planes of this rank: range[0] <= k < range[1]. */
static inline void mg_range(const struct mg_level *l, size_t range[2])
{
	const struct mg_axis *z = &l->axis[2];
	range[0] = l->first > z->first ? l->first : z->first;
	range[1] = l->first + l->here < z->end ? l->first + l->here : z->end;
	range[1] = range[1] < range[0] ? range[0] : range[1];
}

/* Every row of u is kept closed by who changes it: behind its last node stands the right neighbour of that, folded at the face. */
static inline void mg_close_row(const struct mg_level *l, mg_number *u)
{
	const struct mg_axis *x = &l->axis[0];
	u[mg_slot(l, x->points)] = u[mg_slot(l, mg_above(x, x->points - 1))];
}

/* Left of node 0, folded at the face. */
static inline mg_number mg_left_end(const struct mg_level *l, const mg_number *u) { return u[mg_slot(l, mg_below(&l->axis[0], 0))]; }

/* The finest grid of a mesh, or its planes on this rank; the next coarser one with fine->map[].parent, w and a, *more false if there is none.
 * False: no memory. */
bool pm_mg_level_finest(struct mg_level *l, const struct pm_grid *g, int order, const struct pm_planes *planes);
bool pm_mg_level_coarser(struct mg_level *fine, struct mg_level *coarse, bool *more);
/* All planes of a grid of which `part` is that of a rank. */
bool pm_mg_level_whole(const struct mg_level *part, struct mg_level *l);
void pm_mg_level_free(struct mg_level *l); /* with its map */

#endif
