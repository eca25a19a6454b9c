/* The right-hand sides with which full multigrid of order 4 starts: the source itself on every grid by cubic interpolation, made compact there.
 *   s_c(x) = cubic through the four fine nodes around x (the fine node where they coincide);  f_c = s_c + sum_d H_d^2/12 D_d s_c
 * To restrict the compact source of the fine grid instead would leave (H^2 - h^2)/12 lap s on the coarse one, an error of order 2, and full weighting one of
 * order 1 beside a wall where s does not vanish. The means of singular problems are removed grid by grid. It misses a source on a single odd node, which the
 * later cycles correct. Source: Brandt 1977 (the order of transfers in full multigrid). Cost: 20 operations per node, once.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-hierarchy.h"
#include "mesh/mesh-sum.h"

#include <string.h>

/* Axis d of a grid is axis 0; 0, 2; or 0, 1, 2 of a level. */
static int axis_of(const struct mg_level *l, int d) { return l->dim == 2 && d == 1 ? 2 : d; }

static struct pm_grid grid_of(const struct mg_level *l)
{
	struct pm_grid g = {.dim = l->dim, .cells = {1, 1, 1}, .points = {1, 1, 1}, .h = {1, 1, 1}};
	for (int d = 0; d < l->dim; d++) {
		const struct mg_axis *a = &l->axis[axis_of(l, d)];
		g.cells[d] = a->cells, g.points[d] = a->points, g.h[d] = a->h;
		for (int s = 0; s < 2; s++)
			g.face[d][s] = a->periodic ? PM_PERIODIC : a->neumann[s] ? PM_NEUMANN : PM_WALL;
	}
	return g;
}

/* Along one axis, the others as they are; from and to: planar arrays with g.points, of which to has c->points along d. */
static void along(const struct pm_grid *g, int d, const struct mg_axis *f, const struct mg_axis *c, const double *from, double *to)
{
	size_t inner = 1, outer = 1;
	for (int e = 0; e < 3; e++)
		*(e < d ? &inner : &outer) *= e == d ? 1 : g->points[e];
	#pragma omp parallel for num_threads(pm_threads()) if (pm_grid_size(g) > mg_parallel)
	for (size_t o = 0; o < outer; o++)
		for (size_t i = 0; i < c->points; i++) {
			size_t below = i * f->cells / c->cells, node[mg_cubic] = {0};
			double w[mg_cubic] = {0};
			pm_mg_lagrange(f, (ptrdiff_t)below, (double)(i * f->cells) / (double)c->cells, node, w);
			for (size_t p = 0; p < inner; p++) {
				double sum = 0;
				for (int m = 0; m < mg_cubic; m++)
					sum += w[m] * from[(o * f->points + node[m]) * inner + p];
				to[(o * c->points + i) * inner + p] = sum;
			}
		}
}

/* values: of the points of the level; f of the level from them. */
static void load(struct mg_level *l, double factor, const double *values)
{
	const struct mg_axis *x = &l->axis[0], *y = x + 1, *z = x + 2;
	struct pm_grid g = grid_of(l);
	double mean = l->fixed ? 0 : pm_grid_sum(&g, values, NULL) / ((double)g.cells[0] * (double)g.cells[1] * (double)g.cells[2]);
	memset(l->f, 0, mg_size(l) * sizeof *l->f);
	for (size_t k = z->first; k < z->end; k++)
		for (size_t j = y->first; j < y->end; j++)
			for (size_t i = x->first; i < x->end; i++)
				l->f[k * l->plane + j * l->stride + mg_slot(l, i)] = factor * (values[(k * y->points + j) * x->points + i] - mean);
}

bool pm_mg_pyramid(struct pm_mg *mg, double factor, const double *s)
{
	struct pm_grid g = grid_of(&mg->level[0]);
	size_t size = pm_grid_size(&g);
	double *a = pm_alloc(size, sizeof *a), *b = pm_alloc(size, sizeof *b);
	if (a && b)
		memcpy(a, s, size * sizeof *a);
	for (int at = 1; a && b && at < mg->levels; at++) {
		struct mg_level *f = &mg->level[at - 1], *c = &mg->level[at];
		for (int d = 0; d < f->dim; d++) {
			const struct mg_axis *fine = &f->axis[axis_of(f, d)], *coarse = &c->axis[axis_of(f, d)];
			if (fine->points == coarse->points)
				continue;
			along(&g, d, fine, coarse, a, b);
			g.points[d] = coarse->points;
			double *t = a;
			a = b, b = t;
		}
		g = grid_of(c);
		pm_mg_compact_source(&g, a, b);
		load(c, factor, b);
	}
	bool good = a && b;
	pm_free(a), pm_free(b);
	return good;
}
