/* The right-hand sides with which full multigrid of order 4 starts: the source itself on every grid by cubic interpolation, made compact there.
 *   s_c(x) = cubic through the four fine nodes around x (the fine node where they coincide);  f_c = s_c + sum_d H_d^2/12 D_d s_c
 * To restrict the compact source of the fine grid instead would leave (H^2 - h^2)/12 lap s on the coarse one, an error of order 2, and full weighting one of
 * order 1 beside a wall where s does not vanish. The means of singular problems are removed grid by grid. It misses a source on a single odd node, which the
 * later cycles correct. Source: Brandt 1977 (the order of transfers in full multigrid). Cost: 20 operations per node, once.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-ranks.h"
#include "world/world.h"

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

/* The same along the axis of planes, for those of the level c on this rank; from has mg_beyond more on either side, of `inner` values each. */
static void along_planes(const struct mg_level *f, const struct mg_level *c, size_t inner, const double *from, double *to)
{
	const struct mg_axis *fine = &f->axis[2], *coarse = &c->axis[2];
	#pragma omp parallel for num_threads(pm_threads()) if (c->here * inner > mg_parallel)
	for (size_t i = c->first; i < c->first + c->here; i++) {
		size_t node[mg_cubic] = {0};
		double w[mg_cubic] = {0};
		pm_mg_lagrange(fine, (ptrdiff_t)(i * fine->cells / coarse->cells), (double)(i * fine->cells) / (double)coarse->cells, node, w);
		for (size_t p = 0; p < inner; p++) {
			double sum = 0;
			for (int m = 0; m < mg_cubic; m++)
				sum += w[m] * (w[m] != 0 ? from + ((ptrdiff_t)(mg_plane(f, node[m]) / f->plane) - mg_beyond) * (ptrdiff_t)inner : from)[p];
			to[(i - c->first) * inner + p] = sum;
		}
	}
}

/* Of values of the planes here. */
static double mean_of(struct pm_mg *mg, const struct mg_level *l, const struct pm_grid *g, const double *values)
{
	const struct mg_axis *z = &l->axis[2];
	const struct pm_planes planes = {.points = {g->points[0], g->points[1], g->points[2]}, .axis = l->dim - 1, .all = z->points,
		.size = pm_grid_size(g) / z->points, .first = l->first, .here = l->here, .periodic = z->periodic, .divided = l->from, .from = l->from};
	struct pm_sum all = {0, 0};
	double end[3][2];
	for (int d = 0; d < 3; d++)
		end[d][0] = end[d][1] = g->points[d] > g->cells[d] ? 0.5 : 1;
	mg->status = pm_planes_sum(mg->status, &planes, values, NULL, (const double(*)[2])end, &all);
	return pm_sum_total(all) / ((double)g->cells[0] * (double)g->cells[1] * (double)g->cells[2]);
}

/* values: of the points of the level here; f of the level from them. */
static void load(struct pm_mg *mg, struct mg_level *l, double factor, const double *values)
{
	const struct mg_axis *x = &l->axis[0], *y = x + 1;
	struct pm_grid g = grid_of(l);
	double mean = l->fixed ? 0 : mean_of(mg, l, &g, values);
	size_t range[2];
	mg_range(l, range);
	l->beside = false;
	memset(l->f, 0, mg_held(l) * sizeof *l->f);
	for (size_t k = range[0]; k < range[1]; k++)
		for (size_t j = y->first; j < y->end; j++) {
			const double *row = values + ((k - l->first) * y->points + j) * x->points;
			for (size_t i = x->first; i < x->end; i++)
				l->f[mg_plane(l, k) + j * l->stride + mg_slot(l, i)] = factor * (row[i] - mean);
		}
}

/* From the source a of grid f to that of grid c, by way of b: which of the two has it. */
static double *coarser(struct pm_mg *mg, const struct mg_level *f, const struct mg_level *c, double *a, double *b)
{
	struct pm_grid g = grid_of(f);
	for (int d = 0; d < f->dim; d++) {
		const struct mg_axis *fine = &f->axis[axis_of(f, d)], *coarse = &c->axis[axis_of(f, d)];
		const bool planes = f->from && d == f->dim - 1;
		if (fine->points == coarse->points)
			continue;
		if (planes) {
			const size_t inner = pm_grid_size(&g) / g.points[d];
			pm_mg_beside_own(mg, f, a, inner * sizeof *a, mg_beyond);
			along_planes(f, c, inner, a, b);
		} else {
			struct pm_grid here = g;
			here.points[f->dim - 1] = f->from ? f->here : g.points[f->dim - 1];
			along(&here, d, fine, coarse, a, b);
		}
		g.points[d] = coarse->points;
		double *t = a;
		a = b, b = t;
	}
	return a;
}

bool pm_mg_pyramid(struct pm_mg *mg, double factor, const double *s)
{
	const struct mg_level *finest = &mg->level[0];
	const size_t plane = finest->axis[0].points * finest->axis[1].points, here = finest->here * plane;
	const size_t own = finest->from ? mg_beyond * plane : 0;
	double *room[2] = {pm_alloc(here + 2 * own + 1, sizeof(double)), pm_alloc(here + 2 * own + 1, sizeof(double))};
	bool good = room[0] && room[1];
	if (finest->from)
		mg->status = pm_world_agree(mg->status ? mg->status : good ? 0 : pm_failed());
	good = good && !mg->status;
	double *a = good ? room[0] + own : NULL;
	if (good)
		memcpy(a, s, here * sizeof *a);
	for (int at = 1; good && at < mg->levels; at++) {
		struct mg_level *c = &mg->level[at];
		a = coarser(mg, &mg->level[at - 1], c, a, a == room[0] + own ? room[1] + own : room[0] + own);
		double *b = a == room[0] + own ? room[1] + own : room[0] + own;
		const struct pm_grid g = grid_of(c);
		pm_mg_beside_own(mg, c, a, pm_grid_size(&g) / c->axis[2].points * sizeof *a, 2);
		pm_mg_compact_source(&g, c, a, b);
		load(mg, c, factor, b);
	}
	if (good && mg->shared && mg->levels > 1)
		pm_mg_whole_pyramid(mg, factor, a);
	pm_free(room[0]), pm_free(room[1]);
	return good;
}
