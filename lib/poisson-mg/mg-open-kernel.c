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

void pm_mg_lift(const struct pm_grid *g, const struct mg_stencil *a, const double *walls, double *f)
{
	const size_t step[3] = {1, g->points[0], g->points[0] * g->points[1]};
	#pragma omp parallel for num_threads(pm_threads()) if (pm_grid_size(g) > mg_parallel)
	for (size_t row = 0; row < g->points[1] * g->points[2]; row++)
		for (size_t i = 0; i < g->points[0]; i++) {
			const size_t at[3] = {i, row % g->points[1], row / g->points[1]};
			bool beside = false, wall = false;
			for (int d = 0; d < g->dim; d++) {
				beside |= (at[d] == 1 && g->face[d][0] == PM_WALL) || at[d] + 2 == g->points[d];
				wall |= (at[d] == 0 && g->face[d][0] == PM_WALL) || at[d] + 1 == g->points[d];
			}
			for (int o = 0; o < a->n && beside && !wall; o++) {
				size_t to = 0;
				for (int d = 0; d < 3; d++) {
					ptrdiff_t x = (ptrdiff_t)at[d] + a->shift[o][d];
					to += step[d] * (size_t)(x < 0 ? -x : x); /* even images below a neumann face */
				}
				f[i + row * step[1]] -= a->w[o] * walls[to];
			}
		}
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

static bool on_high_face(const struct pm_grid *g, const size_t at[3])
{
	bool on = false;
	for (int d = 0; d < g->dim; d++)
		on |= at[d] + 1 == g->points[d];
	return on;
}

/* value: of the points of n, f: room for as many */
static int solve_near(const struct pm_grid *n, int order, double *value, double *f)
{
	struct mg_stencil a = pm_mg_stencil(n, order);
	struct pm_mg_choice o = {.pre = 2, .post = 2, .smoother = order == 4 ? PM_MG_FOUR_COLOUR : PM_MG_SOR, .cycle = PM_MG_FMG, .tolerance = 1e-13,
		.most = 60};
	struct pm_mg_record *r = pm_alloc(1, sizeof *r);
	struct pm_mg *mg = pm_mg_new(n, order);
	size_t size = pm_grid_size(n), at[3];
	o.relaxation = pm_mg_relaxation(o.smoother, n->dim, order);
	for (size_t p = 0; p < size; p++) {
		at[0] = p % n->points[0], at[1] = p / n->points[0] % n->points[1], at[2] = p / n->points[0] / n->points[1];
		f[p] = p == 0;
		value[p] = on_high_face(n, at) ? far(n, order, at) : 0;
	}
	pm_mg_lift(n, &a, value, f);
	int status = mg && r ? pm_mg_solve_differences(mg, &o, 1, f, NULL, f, r) : -PM_DATA;
	for (size_t p = 0; p < size; p++)
		value[p] += f[p]; /* 0 on the faces */
	pm_mg_free(mg), pm_free(r);
	return status;
}

static void fill(const struct pm_grid *g, int order, const struct pm_grid *n, const double *near, double *table)
{
	#pragma omp parallel for num_threads(pm_threads()) if (pm_grid_size(g) > mg_parallel)
	for (size_t row = 0; row < g->points[1] * g->points[2]; row++) {
		size_t at[3] = {0, row % g->points[1], row / g->points[1]};
		for (at[0] = 0; at[0] < g->points[0]; at[0]++) {
			bool inside = near && at[0] < n->points[0] && at[1] < n->points[1] && at[2] < n->points[2];
			table[at[0] + row * g->points[0]] = inside ? near[at[0] + n->points[0] * (at[1] + n->points[1] * at[2])] : far(g, order, at);
		}
	}
}

int pm_mg_lattice(const struct pm_grid *g, int order, double *table)
{
	struct pm_grid n = octant(g);
	size_t size = pm_grid_size(&n);
	if (g->dim == 1) { /* exact everywhere */
		fill(g, order, &n, NULL, table);
		return 0;
	}
	double *near = pm_alloc(size, sizeof *near), *f = pm_alloc(size, sizeof *f);
	int status = near && f ? solve_near(&n, order, near, f) : -PM_DATA;
	if (!status)
		fill(g, order, &n, near, table);
	pm_free(near), pm_free(f);
	return status;
}
