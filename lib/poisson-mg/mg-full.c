/* The transfers that start full multigrid: cubic interpolation of the solution, and a restriction of the right-hand side that keeps cubics too.
 *   u_fine = P3 u;  f_coarse = (-1 0 9 16 9 0 -1)/32 f per axis where every second node is kept, the transpose of cubic interpolation
 * Full weighting would add h^2/4 f'' to f on the coarse grids, an error as large as that of the differences: one pass with V(1,1) then leaves 2.2 times
 * the error of the differences, this one 1.7, as injection does, but injection misses a point source on an odd node. Linear instead of cubic
 * interpolation leaves 4 times (case PS-10). On axes of any other ratio f goes as in mg-transfer.c. Interpolation is one-sided at walls.
 * Source: Brandt 1977; Trottenberg, Oosterlee, Schueller 2001, section 2.6. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-ranks.h"

#include <string.h>

void pm_mg_lagrange(const struct mg_axis *c, ptrdiff_t below, double x, size_t *node, double *w)
{
	ptrdiff_t n = (ptrdiff_t)c->points, q = c->periodic || n > mg_cubic ? mg_cubic : n, start = below - 1;
	if (!c->periodic)
		start = start < 0 ? 0 : start > n - q ? n - q : start;
	for (ptrdiff_t m = 0; m < q; m++) {
		node[m] = mg_fold(start + m, c);
		w[m] = 1;
		for (ptrdiff_t o = 0; o < q; o++)
			if (o != m)
				w[m] *= (x - (double)(start + o)) / (double)(m - o);
	}
}

static void add_entry(size_t node, double weight, size_t *nodes, double *w)
{
	int m = 0;
	while (m < mg_cubic - 1 && w[m] != 0 && nodes[m] != node)
		m++;
	nodes[m] = node;
	w[m] += weight;
}

static void restriction(const struct mg_axis *f, const struct mg_axis *c, struct mg_map *map)
{
	static const double stencil[7] = {-1. / 32, 0, 9. / 32, 16. / 32, 9. / 32, 0, -1. / 32};
	if (map->half)
		for (size_t i = 0; i < c->points; i++)
			for (ptrdiff_t o = -3; o <= 3; o++) {
				size_t at = mg_cubic * mg_fold(2 * (ptrdiff_t)i + o, f);
				if (stencil[o + 3] != 0)
					add_entry(i, stencil[o + 3], map->four[1] + at, map->cubic[1] + at);
			}
	else
		for (size_t i = 0; i < f->points; i++)
			for (int m = 0; m < 2; m++)
				if (map->a[m][i] != 0)
					add_entry(mg_fold(map->parent[i] + m, c), map->a[m][i], map->four[1] + mg_cubic * i, map->cubic[1] + mg_cubic * i);
}

bool pm_mg_full_tables(const struct mg_axis *f, const struct mg_axis *c, struct mg_map *map)
{
	for (int m = 0; m < 2; m++) {
		map->four[m] = pm_zalloc(f->points, mg_cubic * sizeof(size_t));
		map->cubic[m] = pm_zalloc(f->points, mg_cubic * sizeof(double));
		if (!map->four[m] || !map->cubic[m])
			return false;
	}
	for (size_t i = 0; i < f->points; i++)
		pm_mg_lagrange(c, map->parent[i], (double)map->parent[i] + map->w[1][i], map->four[0] + mg_cubic * i, map->cubic[0] + mg_cubic * i);
	restriction(f, c, map);
	return true;
}

static struct mg_parents parents(const struct mg_map *map, int way, size_t i)
{
	struct mg_parents p = {0};
	for (size_t m = mg_cubic * i; m < mg_cubic * (i + 1); m++)
		if (map->cubic[way][m] != 0)
			p.node[p.n] = map->four[way][m], p.w[p.n++] = map->cubic[way][m];
	return p;
}

/* Node i of a fine row from the coarse values t, by the table. */
static double interpolated(const struct mg_map *map, size_t i, const mg_number *t)
{
	const size_t *four = map->four[0] + mg_cubic * i;
	const double *c = map->cubic[0] + mg_cubic * i;
	return (c[0] * t[four[0]] + c[1] * t[four[1]]) + (c[2] * t[four[2]] + c[3] * t[four[3]]);
}

/* u_2i = t_i, u_2i+1 = (-t_i-1 + 9 t_i + 9 t_i+1 - t_i+2)/16, one-sided at the ends unless periodic. */
static void interpolate_half(const struct mg_level *fine, const struct mg_axis *coarse, const mg_number *restrict t, mg_number *restrict u)
{
	const struct mg_axis *x = &fine->axis[0];
	mg_number *odd = u + fine->half;
	ptrdiff_t n = (ptrdiff_t)(x->points / 2); /* signed, for i - 1 is below zero in the first one */
	for (size_t i = 0; i < coarse->points; i++)
		u[i] = t[i];
	for (ptrdiff_t i = 0; i < n; i++)
		odd[i] = (mg_number)0.0625 * (9 * (t[i] + t[i + 1]) - (t[i - 1] + t[i + 2]));
	if (!x->periodic) {
		odd[0] = interpolated(&fine->map[0], 1, t);
		odd[n - 1] = interpolated(&fine->map[0], 2 * (size_t)n - 1, t);
	}
}

void pm_mg_interpolate_plane(const struct mg_level *fine, const struct mg_level *coarse, size_t k, mg_number *w)
{
	const struct mg_axis *x = &fine->axis[0], *y = &fine->axis[1];
	struct mg_parents pz = parents(&fine->map[2], 0, k);
	mg_number *t = w + mg_lanes;
	for (size_t j = y->first; j < y->end; j++) {
		struct mg_parents py = parents(&fine->map[1], 0, j);
		mg_number *u = fine->u + mg_plane(fine, k) + j * fine->stride;
		pm_mg_gather(coarse, &py, &pz, t);
		if (fine->map[0].half)
			interpolate_half(fine, &coarse->axis[0], t, u);
		else
			for (size_t i = x->first; i < x->end; i++)
				u[mg_slot(fine, i)] = interpolated(&fine->map[0], i, t);
		mg_close_row(fine, u);
	}
}

/* c_i = (16 f_2i + 9 (f_2i-1 + f_2i+1) - (f_2i-3 + f_2i+3))/32, node after node; w: room for the odd half with two values more at each end. */
static void collect_half(const struct mg_level *fine, size_t points, const mg_number *restrict f, mg_number *restrict c, mg_number *restrict w)
{
	const struct mg_axis *x = &fine->axis[0];
	mg_number *odd = w + mg_lanes;
	size_t n = x->points / 2;
	memcpy(odd, f + fine->half, n * sizeof *odd);
	for (ptrdiff_t o = -2; o <= 2; o++) { /* -3, -1 on the left; on the right the next two */
		ptrdiff_t i = o < 0 ? o : (ptrdiff_t)n + o;
		odd[i] = f[mg_slot(fine, mg_fold(2 * i + 1, x))];
	}
	for (ptrdiff_t i = 0; i < (ptrdiff_t)points; i++)
		c[i] = (mg_number)0.03125 * (16 * f[i] + 9 * (odd[i - 1] + odd[i]) - (odd[i - 2] + odd[i + 1]));
}

/* A row of f onto a coarse row c. */
static void collect(const struct mg_level *fine, const struct mg_level *coarse, const mg_number *f, mg_number *c)
{
	const struct mg_axis *x = &fine->axis[0];
	mg_number *t = c + coarse->stride, *w = t + coarse->stride;
	if (fine->map[0].half) {
		collect_half(fine, coarse->axis[0].points, f, t, w);
		pm_mg_fold_row(coarse, t, c);
		return;
	}
	memset(c, 0, coarse->stride * sizeof *c);
	for (size_t i = x->first; i < x->end; i++)
		for (size_t m = mg_cubic * i; m < mg_cubic * (i + 1); m++)
			c[mg_slot(coarse, fine->map[0].four[1][m])] += fine->map[0].cubic[1][m] * f[mg_slot(fine, i)];
}

/* Coarse planes range[0] <= K < range[1], each summed in the order of the fine planes, of which each is summed along y first, where u of the first coarse plane
 * is: u is not in use yet and is 0 again at the end. */
static void restrict_range(const struct mg_level *fine, const struct mg_level *coarse, const size_t range[2], mg_number *c)
{
	const struct mg_axis *y = &fine->axis[1], *z = &fine->axis[2];
	if (range[0] == range[1])
		return;
	mg_number *sum = coarse->u + mg_plane(coarse, range[0]);
	memset(coarse->f + mg_plane(coarse, range[0]), 0, (range[1] - range[0]) * coarse->plane * sizeof *coarse->f);
	for (size_t k = z->first; k < z->end; k++) {
		struct mg_parents pz = parents(&fine->map[2], 1, k);
		bool any = false;
		for (int a = 0; a < pz.n; a++)
			any |= pz.node[a] >= range[0] && pz.node[a] < range[1];
		if (!any)
			continue;
		memset(sum, 0, coarse->plane * sizeof *sum);
		for (size_t j = y->first; j < y->end; j++) {
			struct mg_parents py = parents(&fine->map[1], 1, j);
			collect(fine, coarse, fine->f + mg_plane(fine, k) + j * fine->stride, c);
			for (int b = 0; b < py.n; b++)
				pm_mg_add_row(coarse->stride, py.w[b], c, sum + py.node[b] * coarse->stride);
		}
		for (int a = 0; a < pz.n; a++)
			if (pz.node[a] >= range[0] && pz.node[a] < range[1])
				pm_mg_add_row(coarse->plane, pz.w[a], sum, coarse->f + mg_plane(coarse, pz.node[a]));
	}
	memset(sum, 0, coarse->plane * sizeof *sum);
}

void pm_mg_restrict_source(struct pm_mg *mg, int at)
{
	struct mg_level *fine = &mg->level[at], *coarse = fine + 1;
	pm_mg_beside(mg, fine, fine->f, mg_beyond);
	fine->beside = true;
	coarse->beside = false;
	size_t n = coarse->here, parts = (size_t)mg->threads < n / 8 && mg_size(fine) > mg_parallel ? (size_t)mg->threads : 1;
	#pragma omp parallel for num_threads((int)parts) schedule(static, 1) if (parts > 1)
	for (size_t p = 0; p < parts; p++) {
		size_t range[2] = {coarse->first + n * p / parts, coarse->first + n * (p + 1) / parts};
		restrict_range(fine, coarse, range, mg->scratch + p * mg->room);
	}
}
