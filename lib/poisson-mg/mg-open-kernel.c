/* The Green's function of the differences on the infinite lattice, for James' method.
 *   far:  A G = delta, G = V (G0 + G1), V the volume of a cell, G0 = -1/(4 pi r), ln(r)/(2 pi) or |x|/2, and for order 2
 *   G1 = sum_d h_d^2 (r^2 - x_d^2)(5 x_d^2 - r^2)/(32 pi r^7) in 3-D, -sum_d h_d^2 (3/r^2 - 12 x_d^2/r^4 + 8 x_d^4/r^6)/(48 pi) in 2-D
 * (lap G1 = -sum_d h_d^2/12 d^4 G0/dx_d^4; Duffin 1953 for the cubic lattice); compact differences of order 4 have no such term. What is left is (h/r)^4 of G0.
 * near: the differences themselves solved by multigrid in one octant of a box of `reach` cells to each side, with the far values on its faces. So the error
 * is that of the far form at its edge, 1e-8 of G at the origin in 3-D, and G at the origin needs no special treatment.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-open-parts.h"

#include <string.h>

enum { reach_2d = 128, reach_3d = 32 };

struct mg_stencil pm_mg_stencil(const struct pm_grid *g, int order)
{
	struct mg_stencil a = {0};
	double w[3] = {0};
	for (int d = 0; d < g->dim; d++)
		w[d] = 1 / (g->h[d] * g->h[d]);
	for (int o = 0; o < 27; o++) {
		const int s[3] = {o % 3 - 1, o / 3 % 3 - 1, o / 9 - 1};
		double value = 0;
		for (int d = 0; d < 3; d++) {
			bool others = false;
			for (int e = 0; e < 3; e++)
				others |= e != d && s[e];
			value += others ? 0 : s[d] ? w[d] : -2 * w[d];
			for (int e = d + 1; e < 3 && order == 4; e++)
				if (!s[3 - d - e])
					value += w[d] * w[e] * (g->h[d] * g->h[d] + g->h[e] * g->h[e]) / 12 * (s[d] ? 1 : -2) * (s[e] ? 1 : -2);
		}
		bool outside = false;
		for (int d = g->dim; d < 3; d++)
			outside |= s[d] != 0;
		if (outside || value == 0)
			continue;
		memcpy(a.shift[a.n], s, sizeof s);
		a.w[a.n++] = value;
	}
	return a;
}

static double far(const struct pm_grid *g, int order, const size_t at[3])
{
	double x2[3] = {0}, r2 = 0, volume = pm_grid_cell(g), sum = 0;
	for (int d = 0; d < g->dim; d++) {
		x2[d] = pow(g->h[d] * (double)at[d], 2);
		r2 += x2[d];
	}
	double r = sqrt(r2);
	if (g->dim == 1)
		return volume * r / 2;
	for (int d = 0; d < g->dim && order == 2; d++)
		if (g->dim == 3)
			sum += g->h[d] * g->h[d] * (r2 - x2[d]) * (5 * x2[d] - r2) / (32 * pm_pi * r2 * r2 * r2 * r);
		else
			sum -= g->h[d] * g->h[d] * (3 - 12 * x2[d] / r2 + 8 * x2[d] * x2[d] / (r2 * r2)) / (48 * pm_pi * r2);
	return volume * (sum + (g->dim == 3 ? -1 / (4 * pm_pi * r) : log(r) / (2 * pm_pi)));
}

/* One octant around the source: even at its low faces, the far field on its high ones. */
static struct pm_grid octant(const struct pm_grid *g)
{
	struct pm_grid n = *g;
	double widest = fmax(g->h[0], fmax(g->dim > 1 ? g->h[1] : 0, g->dim > 2 ? g->h[2] : 0));
	for (int d = 0; d < g->dim; d++) {
		n.cells[d] = (size_t)ceil((g->dim == 3 ? reach_3d : reach_2d) * widest / g->h[d]);
		n.points[d] = n.cells[d] + 1;
		n.face[d][0] = PM_NEUMANN;
		n.face[d][1] = PM_WALL;
	}
	return n;
}

struct mg_lattice {
	struct pm_grid grid, octant; /* near: of the points of the octant; NULL in 1-D, where far() is exact everywhere */
	int order;
	double *near;
};

struct mg_lattice *pm_mg_lattice_free(struct mg_lattice *l)
{
	if (l)
		pm_free(l->near);
	return pm_free(l);
}

/* The values on the high faces of the octant. */
static int far_faces(const struct mg_lattice *l, struct pm_boundary *b)
{
	const struct pm_grid *n = &l->octant;
	for (int d = 0; d < n->dim; d++) {
		const int low = d == 0, high = d == 2 ? 1 : 2;
		if (pm_boundary_room(b, d, 1))
			return -PM_DATA;
		for (size_t i = 0; i < pm_boundary_points(n, d); i++) {
			size_t at[3];
			at[d] = n->points[d] - 1, at[low] = i % n->points[low], at[high] = i / n->points[low];
			b->value[d][1][i] = far(n, l->order, at);
		}
	}
	return 0;
}

/* near of the octant; f: room for as many */
static int solve_near(struct mg_lattice *l, double *f)
{
	const struct pm_grid *n = &l->octant;
	struct pm_mg_choice o = {.pre = 2, .post = 2, .smoother = l->order == 4 ? PM_MG_FOUR_COLOUR : PM_MG_SOR, .cycle = PM_MG_FMG, .tolerance = 1e-13,
		.most = 60};
	struct pm_mg_record *r = pm_alloc(1, sizeof *r);
	struct pm_mg *mg = pm_mg_new(n, l->order);
	struct pm_boundary b = {.grid = *n};
	int status = mg && r ? far_faces(l, &b) : pm_failed();
	o.relaxation = pm_mg_relaxation(o.smoother, n->dim, l->order);
	if (!status) {
		pm_boundary_known(&b, l->order, PM_BOUNDARY_ALL, NULL, f);
		for (size_t p = 0; p < pm_grid_size(n); p++)
			f[p] = (p == 0) - f[p];
		status = pm_mg_solve_differences(mg, &o, 1, f, NULL, l->near, r);
		pm_boundary_set(&b, l->near);
	}
	pm_boundary_free(&b);
	pm_mg_free(mg), pm_free(r);
	return status;
}

struct mg_lattice *pm_mg_lattice_new(const struct pm_grid *g, int order)
{
	struct mg_lattice *l = pm_zalloc(1, sizeof *l);
	if (!l)
		return NULL;
	l->grid = *g;
	l->order = order;
	l->octant = octant(g);
	const size_t size = pm_grid_size(&l->octant);
	double *f = g->dim == 1 ? NULL : pm_alloc(size, sizeof *f);
	if (g->dim > 1 && (!f || !(l->near = pm_alloc(size, sizeof *f)) || solve_near(l, f)))
		l = pm_mg_lattice_free(l);
	pm_free(f);
	return l;
}

double pm_mg_lattice_value(const struct mg_lattice *l, const size_t at[3])
{
	const size_t *n = l->octant.points;
	const bool near = l->near && at[0] < n[0] && at[1] < n[1] && at[2] < n[2];
	return near ? l->near[at[0] + n[0] * (at[1] + n[1] * at[2])] : far(&l->grid, l->order, at);
}

int pm_mg_lattice(const struct pm_grid *g, int order, double *table)
{
	struct mg_lattice *l = pm_mg_lattice_new(g, order);
	#pragma omp parallel for num_threads(pm_threads()) if (pm_grid_size(g) > mg_parallel)
	for (size_t row = 0; row < (l ? g->points[1] * g->points[2] : 0); row++)
		for (size_t i = 0; i < g->points[0]; i++)
			table[i + row * g->points[0]] = pm_mg_lattice_value(l, (size_t[]){i, row % g->points[1], row / g->points[1]});
	const int status = l ? 0 : pm_failed();
	pm_mg_lattice_free(l);
	return status;
}
