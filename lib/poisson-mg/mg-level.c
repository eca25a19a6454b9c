/* Builds one grid of a multigrid hierarchy after the other, with the tables of linear interpolation between them.
 * An axis with an even number n of cells goes to n/2, an odd one to (n+1)/2 cells of the same length, so the grids are no longer nested there but
 * linear interpolation and its transpose still are second order. Only axes whose spacing is within sqrt 2 of the smallest are coarsened (semi-
 * coarsening, Trottenberg, Oosterlee, Schueller 2001, section 5.1.1), so that point relaxation stays a smoother on stretched cells. Axes without a wall end
 * as a single point on which nothing varies, so the coarsest grid has one unknown, or none.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-level.h"
#include "world/world.h"

#include <string.h>

static void axis_fill(struct mg_axis *a)
{
	bool wall[2] = {!a->periodic && !a->neumann[0], !a->periodic && !a->neumann[1]};
	a->points = a->periodic ? a->cells : a->cells + 1;
	a->first = wall[0];
	a->end = a->points - wall[1];
	a->h = a->length / (double)a->cells;
	a->w = a->points == 1 ? 0 : 1 / (a->h * a->h);
}

/* An axis of one point. */
static struct mg_axis axis_flat(double length)
{
	struct mg_axis a = {.cells = 1, .periodic = true, .length = length};
	axis_fill(&a);
	return a;
}

static struct mg_axis axis_of(const struct pm_grid *g, int d)
{
	struct mg_axis a = {.cells = g->cells[d], .length = g->h[d] * (double)g->cells[d], .periodic = g->face[d][0] == PM_PERIODIC};
	for (int s = 0; s < 2; s++)
		a.neumann[s] = g->face[d][s] == PM_NEUMANN;
	axis_fill(&a);
	return a;
}

static bool axis_free(const struct mg_axis *a) { return a->periodic || (a->neumann[0] && a->neumann[1]); }

/* Can it get any coarser? */
static bool axis_coarsens(const struct mg_axis *a)
{
	if (axis_free(a))
		return a->points > 1;
	return a->end - a->first > 1;
}

static struct mg_axis axis_coarse(const struct mg_axis *a)
{
	if (a->cells == 1)
		return axis_flat(a->length);
	struct mg_axis c = *a;
	c.cells = (a->cells + 1) / 2;
	axis_fill(&c);
	return c;
}

static double axis_weight(const struct mg_axis *a, size_t i) /* of quadrature [length] */
{
	return !a->periodic && (i == 0 || i + 1 == a->points) ? a->h / 2 : a->h;
}

static bool map_build(const struct mg_axis *f, const struct mg_axis *c, struct mg_map *map)
{
	map->same = f->cells == c->cells && f->points == c->points;
	map->half = f->cells == 2 * c->cells;
	map->parent = pm_zalloc(f->points, sizeof *map->parent);
	for (int m = 0; m < 2; m++) {
		map->w[m] = pm_zalloc(f->points, sizeof(double));
		map->a[m] = pm_zalloc(f->points, sizeof(double));
	}
	if (!map->parent || !map->w[0] || !map->w[1] || !map->a[0] || !map->a[1])
		return false;
	bool flattened = f->cells == 1 && f->points > c->points; /* two neumann nodes become one */
	for (size_t i = 0; i < f->points; i++) {
		size_t at = flattened ? 0 : i * c->cells, below = at / f->cells;
		double t = (double)(at % f->cells) / (double)f->cells;
		map->parent[i] = (ptrdiff_t)below;
		map->w[0][i] = 1 - t;
		map->w[1][i] = t;
		for (int m = 0; m < 2; m++)
			map->a[m][i] = map->w[m][i] * axis_weight(f, i) / axis_weight(c, mg_fold((ptrdiff_t)below + m, c));
	}
	return true;
}

/* The planes of the coarse grid at or above the first fine plane of every rank. */
static bool planes_coarse(const struct mg_level *fine, struct mg_level *l)
{
	const struct mg_axis *f = &fine->axis[2], *c = &l->axis[2];
	const size_t ranks = (size_t)pm_world_size();
	if (!(l->from = pm_alloc(ranks + 1, sizeof *l->from)))
		return false;
	for (size_t r = 0; r <= ranks; r++) {
		const size_t k = ((size_t)fine->from[r] * c->cells + f->cells - 1) / f->cells;
		l->from[r] = k < c->points ? k : c->points;
	}
	l->from[ranks] = c->points;
	return true;
}

/* Where the planes of this rank are. */
static bool planes_place(struct mg_level *l)
{
	const struct mg_axis *z = &l->axis[2];
	const size_t rank = (size_t)pm_world_rank();
	if (!(l->at = pm_zalloc(z->points, sizeof *l->at)))
		return false;
	l->first = l->from[rank];
	l->here = l->from[rank + 1] - l->from[rank];
	for (ptrdiff_t away = mg_beyond; away > 0; away--) /* a plane may be on both sides: the nearer one, which is brought whenever the farther one is */
		for (int side = 0; side < 2; side++) {
			const ptrdiff_t n = (ptrdiff_t)z->points, i = side ? (ptrdiff_t)l->here - 1 + away : -away, k = (ptrdiff_t)l->first + i;
			if ((k >= 0 && k < n) || z->periodic)
				l->at[((k % n) + n) % n] = (size_t)(i + mg_beyond) * l->plane;
		}
	for (size_t i = 0; i < l->here; i++)
		l->at[l->first + i] = (i + mg_beyond) * l->plane;
	return true;
}

static bool level_alloc(struct mg_level *l)
{
	const struct mg_axis *x = &l->axis[0];
	l->half = mg_whole(x->points / 2 + 1); /* with what closes a row; vectors read on behind it, into the other half or the next row */
	l->stride = 2 * l->half;
	l->plane = l->stride * l->axis[1].points;
	if (l->plane % (4096 / sizeof *l->u) == 0 && l->axis[1].points > 1) /* planes a multiple of 4 KiB apart would share the sets of the cache */
		l->plane += mg_lanes;
	for (int d = 0; d < 3; d++)
		l->fixed |= !axis_free(&l->axis[d]);
	l->here = l->axis[2].points;
	if (l->from && !planes_place(l))
		return false;
	l->u = pm_zalloc(mg_held(l) + mg_lanes, sizeof *l->u);
	l->f = pm_zalloc(mg_held(l) + mg_lanes, sizeof *l->f);
	for (int m = 0; m < 2; m++)
		if (!(l->mask[m] = pm_zalloc(l->half, sizeof *l->mask[m])))
			return false;
	for (size_t i = x->first; i < x->end; i++)
		l->mask[i & 1][i / 2] = -1;
	return l->u && l->f;
}

bool pm_mg_level_coarser(struct mg_level *fine, struct mg_level *coarse, bool *more)
{
	double smallest = INFINITY;
	*more = false;
	for (int d = 0; d < 3; d++)
		if (axis_coarsens(&fine->axis[d]))
			smallest = fmin(smallest, fine->axis[d].h), *more = true;
	if (!*more)
		return true;
	coarse->dim = fine->dim;
	coarse->order = fine->order;
	for (int d = 0; d < 3; d++) {
		const struct mg_axis *a = &fine->axis[d];
		coarse->axis[d] = axis_coarsens(a) && a->h < 1.42 * smallest ? axis_coarse(a) : *a;
		if (!map_build(a, &coarse->axis[d], &fine->map[d]))
			return false;
	}
	return (!fine->from || planes_coarse(fine, coarse)) && level_alloc(coarse);
}

bool pm_mg_level_finest(struct mg_level *l, const struct pm_grid *g, int order, const struct pm_planes *planes)
{
	l->dim = g->dim;
	l->order = order;
	l->axis[0] = axis_of(g, 0);
	l->axis[1] = g->dim == 3 ? axis_of(g, 1) : axis_flat(1);
	l->axis[2] = g->dim == 3 ? axis_of(g, 2) : g->dim == 2 ? axis_of(g, 1) : axis_flat(1);
	const size_t ranks = planes && planes->divided ? (size_t)pm_world_size() + 1 : 0;
	if (ranks && !(l->from = pm_alloc(ranks, sizeof *l->from)))
		return false;
	if (ranks)
		memcpy(l->from, planes->from, ranks * sizeof *l->from);
	return level_alloc(l);
}

bool pm_mg_level_whole(const struct mg_level *part, struct mg_level *l)
{
	l->dim = part->dim;
	l->order = part->order;
	for (int d = 0; d < 3; d++)
		l->axis[d] = part->axis[d];
	return level_alloc(l);
}

void pm_mg_level_free(struct mg_level *l)
{
	pm_free(l->from), pm_free(l->at), pm_free(l->u), pm_free(l->f), pm_free(l->v), pm_free(l->mask[0]), pm_free(l->mask[1]);
	for (int d = 0; d < 3; d++) {
		struct mg_map *m = &l->map[d];
		pm_free(m->parent);
		for (int p = 0; p < 2; p++)
			pm_free(m->w[p]), pm_free(m->a[p]), pm_free(m->four[p]), pm_free(m->cubic[p]);
	}
}
