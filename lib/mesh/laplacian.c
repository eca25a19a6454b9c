/* The Laplacian of order 2 on the nodes of a mesh: [1 -2 1]/h^2 per axis (laplacian.h), its weighted sums, and the ends of its spectrum.
 * With W the quadrature weights, 1/2 at the ends of a neumann axis, W lap is symmetric: sums with these weights are the inner product in which conjugate
 * gradients work, and a singular problem is solvable if the weighted mean of its right-hand side is 0. SPDX-License-Identifier: GPL-3.0-or-later */
#include "mesh/laplacian.h"
#include "base/in-order.h"
#include "world/world.h"

#include <string.h>

/* Modes sin or cos(theta i): walls theta = m pi/n, 0 < m < n; neumann 0 <= m <= n; one of each (m - 1/2) pi/n; periodic 2 m pi/n. */
static void axis_modes(struct pm_laplacian_axis *a, int walls)
{
	double n = (double)a->cells, unit = pm_pi / n, half = floor(n / 2);
	if (walls) {
		a->above = cos(walls == 2 ? unit : unit / 2);
		a->below = -a->above;
		a->next = a->above;
		return;
	}
	a->above = 1;
	a->below = a->periodic ? cos(2 * unit * half) : -1;
	a->next = a->cells == 1 && a->periodic ? -1 : cos(a->periodic ? 2 * unit : unit);
}

static struct pm_laplacian_axis axis_of(const struct pm_grid *g, int d)
{
	bool wall[2] = {g->face[d][0] == PM_WALL, g->face[d][1] == PM_WALL};
	struct pm_laplacian_axis a = {.cells = g->cells[d], .points = g->points[d], .periodic = g->face[d][0] == PM_PERIODIC, .first = wall[0],
		.end = g->points[d] - wall[1]};
	a.w = d < g->dim && a.points > 1 ? 1 / (g->h[d] * g->h[d]) : 0;
	axis_modes(&a, wall[0] + wall[1]);
	return a;
}

struct pm_laplacian pm_laplacian_of(const struct pm_grid *g)
{
	struct pm_laplacian l = {.dim = g->dim, .size = pm_grid_size(g), .rows = g->points[1] * g->points[2], .unknowns = 1, .singular = true};
	double nearest = 2;
	for (int d = 0; d < 3; d++) {
		struct pm_laplacian_axis *a = &l.axis[d];
		*a = axis_of(g, d);
		l.diagonal += 2 * a->w;
		l.unknowns *= a->end > a->first ? a->end - a->first : 0;
		l.singular = l.singular && a->above == 1;
	}
	for (int d = 0; d < 3; d++) {
		const struct pm_laplacian_axis *a = &l.axis[d];
		double share = l.diagonal > 0 ? 2 * a->w / l.diagonal : 0;
		l.highest += share * a->above;
		l.lowest += share * a->below;
		if (share > 0)
			nearest = fmin(nearest, share * (1 - a->next));
	}
	if (l.singular)
		l.highest = 1 - nearest;
	return l;
}

/* Eight sums side by side, so that they are computed in one vector. */
static double row_product(const struct pm_laplacian_axis *x, const double *restrict a, const double *restrict b)
{
	double lane[8] = {0}, ends = 0;
	size_t i = x->first;
	if (!x->periodic && x->first == 0)
		ends -= 0.5 * a[0] * b[0];
	if (!x->periodic && x->end == x->points)
		ends -= 0.5 * a[x->points - 1] * b[x->points - 1];
	for (; i + 8 <= x->end; i += 8)
		for (size_t q = 0; q < 8; q++)
			lane[q] += a[i + q] * b[i + q];
	for (; i < x->end; i++)
		ends += a[i] * b[i];
	return (((lane[0] + lane[4]) + (lane[1] + lane[5])) + ((lane[2] + lane[6]) + (lane[3] + lane[7]))) + ends;
}

/* lap u of a row, 0 on nodes that are not unknowns. */
static void row_values(const struct pm_laplacian *l, const struct pm_laplacian_row *a, double *restrict r)
{
	const struct pm_laplacian_axis *x = &l->axis[0];
	const double wx = x->w, wy = l->axis[1].w, wz = l->axis[2].w, diagonal = l->diagonal;
	const double *u = a->u, *y0 = a->y[0], *y1 = a->y[1], *z0 = a->z[0], *z1 = a->z[1];
	size_t last = x->points - 1;
	for (size_t i = 1; i < last; i++)
		r[i] = wx * (u[i - 1] + u[i + 1]) + wy * (y0[i] + y1[i]) + wz * (z0[i] + z1[i]) - diagonal * u[i];
	r[last] = x->end > last ? pm_laplacian_node(l, a, last) : 0;
	r[0] = x->first == 0 ? pm_laplacian_node(l, a, 0) : 0;
}

double pm_laplacian_row_residual(const struct pm_laplacian *l, const struct pm_laplacian_row *a, double *restrict r)
{
	row_values(l, a, r);
	for (size_t i = l->axis[0].first; i < l->axis[0].end; i++)
		r[i] -= a->f[i];
	return a->weight * row_product(&l->axis[0], r, r);
}

void pm_laplacian_share(struct pm_laplacian *l, struct pm_laplacian_ranks *ranks)
{
	l->ranks = ranks;
	l->size = ranks->planes.here * ranks->planes.size;
	l->rows = l->size / l->axis[0].points;
	l->first = pm_planes_row(&ranks->planes, 0);
}

void pm_laplacian_beside(const struct pm_laplacian *l, double *u)
{
	if (!l->ranks)
		return;
	const struct pm_planes *p = &l->ranks->planes;
	const struct pm_halo halo = {.from = p->from, .bytes = p->size * sizeof *u, .wide = 1, .periodic = p->periodic};
	l->ranks->status = pm_world_halo(l->ranks->status, &halo, u);
}

double pm_laplacian_most(const struct pm_laplacian *l, double here)
{
	if (l->ranks)
		l->ranks->status = pm_world_largest(l->ranks->status, 1, &here);
	return here;
}

double pm_laplacian_total(const struct pm_laplacian *l, const double *sums)
{
	struct pm_sum all = {0, 0};
	if (l->ranks) {
		l->ranks->status = pm_planes_over(l->ranks->status, &l->ranks->planes, &pm_row_sums, &(struct pm_row_values){sums, l->axis[0].points}, &all);
		return pm_sum_total(all);
	}
	return pm_sum_of_rows((const size_t[3]){l->axis[0].points, l->axis[1].points, l->axis[2].points}, sums);
}

/* Row by row: r = lap u - f and its sum of squares, or, without f, r = lap u and the sum of u r. */
static double over_rows(const struct pm_laplacian *l, double *u, const double *f, double *r, double *sums)
{
	size_t nx = l->axis[0].points, ny = l->axis[1].points;
	pm_laplacian_beside(l, u);
	#pragma omp parallel for schedule(static) if (l->size > pm_laplacian_parallel)
	for (size_t q = 0; q < l->rows; q++) {
		size_t j = (l->first + q) % ny, k = (l->first + q) / ny;
		sums[q] = 0;
		if (!pm_laplacian_inside(l, j, k)) {
			memset(r + q * nx, 0, nx * sizeof *r);
			continue;
		}
		struct pm_laplacian_row a = pm_laplacian_row_at(l, u, f ? f : u, j, k);
		if (f) {
			sums[q] = pm_laplacian_row_residual(l, &a, r + q * nx);
		} else {
			row_values(l, &a, r + q * nx);
			sums[q] = a.weight * row_product(&l->axis[0], a.u, r + q * nx);
		}
	}
	return pm_laplacian_total(l, sums);
}

double pm_laplacian_residual(const struct pm_laplacian *l, double *u, const double *f, double *r, double *sums) { return over_rows(l, u, f, r, sums); }

double pm_laplacian_apply(const struct pm_laplacian *l, double *u, double *r, double *sums) { return over_rows(l, u, NULL, r, sums); }

double pm_laplacian_product(const struct pm_laplacian *l, const double *a, const double *b, double *sums)
{
	size_t nx = l->axis[0].points, ny = l->axis[1].points;
	#pragma omp parallel for schedule(static) if (l->size > pm_laplacian_parallel)
	for (size_t q = 0; q < l->rows; q++) {
		size_t j = (l->first + q) % ny, k = (l->first + q) / ny;
		sums[q] = 0;
		if (pm_laplacian_inside(l, j, k))
			sums[q] = pm_laplacian_weight(&l->axis[1], j) * pm_laplacian_weight(&l->axis[2], k) * row_product(&l->axis[0], a + q * nx, b + q * nx);
	}
	return pm_laplacian_total(l, sums);
}

double pm_laplacian_mean(const struct pm_laplacian *l, const double *a, double *sums)
{
	const struct pm_laplacian_axis *x = &l->axis[0], *y = &l->axis[1], *z = &l->axis[2];
	#pragma omp parallel for schedule(static) if (l->size > pm_laplacian_parallel)
	for (size_t q = 0; q < l->rows; q++) {
		struct pm_sum row = {0};
		for (size_t i = 0; i < x->points; i++)
			pm_sum_add(&row, pm_laplacian_weight(x, i) * a[q * x->points + i]);
		const size_t at = l->first + q;
		sums[q] = pm_laplacian_weight(y, at % y->points) * pm_laplacian_weight(z, at / y->points) * pm_sum_total(row);
	}
	return pm_laplacian_total(l, sums) / ((double)x->cells * (double)y->cells * (double)z->cells);
}
