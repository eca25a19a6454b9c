/* The Laplacian of order 2 on the nodes of a mesh, row by row, with neighbours folded at the faces: periodic wraps, a neumann face mirrors, the nodes of a
 * wall are not unknowns and keep their values. Every sum is over rows, then planes, with the weights of quadrature, in which the operator is symmetric.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_LAPLACIAN_H
#define PM_MESH_LAPLACIAN_H

#include "mesh/planes.h"
#include "mesh/index-fold.h"

struct pm_laplacian_axis {
	size_t cells, points, first, end; /* unknowns first <= i < end */
	bool periodic;
	double w;            /* 1/h^2; 0 on an axis of one point */
	double above, below; /* largest and smallest cosine cos(k h) of its modes, so that an eigenvalue is -2 w (1 - cosine) */
	double next;         /* the largest cosine below 1 where `above` is 1 (a constant), -1 if there is none */
};

struct pm_laplacian {
	int dim;
	struct pm_laplacian_axis axis[3];
	double diagonal;     /* 2 (wx + wy + wz): lap u = sum of w (neighbours) - diagonal u */
	bool singular;       /* constants are in its kernel */
	size_t size, rows, unknowns; /* values and rows on this rank; unknowns of the whole mesh */
	size_t first;        /* row of the mesh that is the first one here */
	struct pm_laplacian_ranks *ranks; /* NULL: all rows are here. Else meshes have room for a plane on either side */
	double highest, lowest; /* of the average over neighbours, sum w cos(k h)/sum w, over all modes but a constant: Jacobi's eigenvalues; -1 <= ... < 1 */
};

/* The planes of a rank, and the status that all ranks have agreed on. */
struct pm_laplacian_ranks {
	struct pm_planes planes;
	int status;
};

enum { pm_laplacian_parallel = 16384 }; /* values below which threads are not worth it */

/* A row of unknowns, its four neighbours and its right-hand side; weight is that of its y and z. */
struct pm_laplacian_row {
	double *u;
	const double *y[2], *z[2], *f;
	size_t left, right;  /* neighbours of the first and the last node */
	double weight;
};

struct pm_laplacian pm_laplacian_of(const struct pm_grid *g); /* faces periodic, wall, neumann */
/* Only the planes of a rank from now on; all ranks call the functions below in the same order. */
void pm_laplacian_share(struct pm_laplacian *l, struct pm_laplacian_ranks *ranks);
/* Brings the planes beside those of this rank, of a mesh that is read at neighbours by other functions than these. */
void pm_laplacian_beside(const struct pm_laplacian *l, double *u);
double pm_laplacian_most(const struct pm_laplacian *l, double here); /* the largest over all ranks */

static inline size_t pm_laplacian_below(const struct pm_laplacian_axis *a, size_t i)
{
	return pm_index_below(i, a->points, a->periodic);
}
static inline size_t pm_laplacian_above(const struct pm_laplacian_axis *a, size_t i)
{
	return pm_index_above(i, a->points, a->periodic);
}
static inline double pm_laplacian_weight(const struct pm_laplacian_axis *a, size_t i)
{
	return !a->periodic && (i == 0 || i + 1 == a->points) ? 0.5 : 1;
}
static inline bool pm_laplacian_inside(const struct pm_laplacian *l, size_t j, size_t k)
{
	return j >= l->axis[1].first && j < l->axis[1].end && k >= l->axis[2].first && k < l->axis[2].end;
}

/* The row (0, j, k) of the mesh, counted from the first one here. */
static inline size_t pm_laplacian_row_of(const struct pm_laplacian *l, size_t j, size_t k) { return j + l->axis[1].points * k - l->first; }

/* The way from node i to its neighbour, along axis 1 or 2: at a periodic end that is divided it lies beyond. */
static inline ptrdiff_t pm_laplacian_way(const struct pm_laplacian *l, int d, size_t i, int up)
{
	const struct pm_laplacian_axis *a = &l->axis[d];
	if (l->ranks && a->periodic && d == l->ranks->planes.axis)
		return up ? 1 : -1;
	return (ptrdiff_t)(up ? pm_laplacian_above(a, i) : pm_laplacian_below(a, i)) - (ptrdiff_t)i;
}

static inline struct pm_laplacian_row pm_laplacian_row_at(const struct pm_laplacian *l, double *u, const double *f, size_t j, size_t k)
{
	const struct pm_laplacian_axis *x = &l->axis[0], *y = &l->axis[1], *z = &l->axis[2];
	const size_t nx = x->points, at = nx * pm_laplacian_row_of(l, j, k);
	const ptrdiff_t row = (ptrdiff_t)nx, plane = row * (ptrdiff_t)y->points;
	return (struct pm_laplacian_row){.u = u + at, .f = f + at,
		.y = {u + at + row * pm_laplacian_way(l, 1, j, 0), u + at + row * pm_laplacian_way(l, 1, j, 1)},
		.z = {u + at + plane * pm_laplacian_way(l, 2, k, 0), u + at + plane * pm_laplacian_way(l, 2, k, 1)},
		.left = pm_laplacian_below(x, 0), .right = pm_laplacian_above(x, nx - 1), .weight = pm_laplacian_weight(y, j) * pm_laplacian_weight(z, k)};
}

/* lap u at node i. */
static inline double pm_laplacian_node(const struct pm_laplacian *l, const struct pm_laplacian_row *a, size_t i)
{
	const struct pm_laplacian_axis *x = &l->axis[0];
	double left = a->u[i ? i - 1 : a->left], right = a->u[i + 1 < x->points ? i + 1 : a->right];
	return x->w * (left + right) + l->axis[1].w * (a->y[0][i] + a->y[1][i]) + l->axis[2].w * (a->z[0][i] + a->z[1][i]) - l->diagonal * a->u[i];
}

/* r = lap u - f on a row, 0 on nodes that are not unknowns; returns the weighted sum of squares. */
double pm_laplacian_row_residual(const struct pm_laplacian *l, const struct pm_laplacian_row *a, double *restrict r);

/* The sum of one number per row, added to planes and to the mesh (base/in-order.h). */
double pm_laplacian_total(const struct pm_laplacian *l, const double *sums);
/* r = lap u - f on all rows, inside only, and the sum of squares; r: size values, sums: rows values, u is only read. */
double pm_laplacian_residual(const struct pm_laplacian *l, double *u, const double *f, double *r, double *sums);
/* r = lap u; returns the weighted sum of u r. */
double pm_laplacian_apply(const struct pm_laplacian *l, double *u, double *r, double *sums);
/* Weighted sums over the unknowns of a*b, and over all nodes of a. */
double pm_laplacian_product(const struct pm_laplacian *l, const double *a, const double *b, double *sums);
double pm_laplacian_mean(const struct pm_laplacian *l, const double *a, double *sums);

#endif
