/* The finest grid of multigrid with a variable coefficient: finite volumes around the nodes.
 *   -sum over faces of e_face (u_neighbour - u)/h^2 = -f,   e_face the harmonic or arithmetic mean of the nodes on its two sides
 * The harmonic mean is exact where eps jumps across a face in a plane layer (Trottenberg, Oosterlee, Schueller 2001, section 7.7). A node on a neumann face
 * has half a volume and half the faces across, which makes the matrix symmetric. Walls are left out: phi = 0 there. SPDX-License-Identifier: GPL-3.0-or-later
 * */
#include "poisson-mg/mg-variable-level.h"
#include "world/world.h"

#include <string.h>

const char *const pm_mg_mean_names[] = {"harmonic", "arithmetic", NULL};

double pm_mg_face(enum pm_mg_mean mean, double a, double b)
{
	return mean == PM_MG_ARITHMETIC ? 0.5 * (a + b) : 2 * a / (a + b) * b; /* in this order nothing overflows */
}

static void offsets(struct mgv_level *l, bool star)
{
	l->n = 1; /* 0: the node itself */
	for (int o = 0; o < mgv_neighbours; o++) {
		const int s[3] = {o % 3 - 1, o / 3 % 3 - 1, o / 9 - 1};
		int far = abs(s[0]) + abs(s[1]) + abs(s[2]);
		if (far == 0 || (star && far > 1) || (l->dim < 3 && s[2]) || (l->dim < 2 && s[1]))
			continue;
		memcpy(l->shift[l->n], s, sizeof s);
		l->at[l->n++] = s[0] + s[1] * (ptrdiff_t)l->stride[1] + s[2] * (ptrdiff_t)l->stride[2];
	}
}

bool pm_mgv_alloc(struct mgv_level *l, bool star)
{
	l->size = 1;
	l->origin = 0;
	l->beyond = l->from ? 2 : 1;
	for (int d = 0; d < 3; d++) {
		const size_t ghosts = d == l->dim - 1 ? (size_t)l->beyond : d < l->dim;
		l->m[d] = l->all[d];
		if (l->from && d == l->dim - 1) {
			l->begin[d] = (size_t)l->from[pm_world_rank()];
			l->m[d] = (size_t)l->from[pm_world_rank() + 1] - l->begin[d];
		}
		l->stride[d] = l->size;
		l->origin += ghosts * l->size;
		l->size *= l->m[d] + 2 * ghosts;
	}
	offsets(l, star);
	bool good = true;
	for (int o = 0; o < l->n; o++)
		good &= (l->w[o] = pm_zalloc(l->size, sizeof(double))) != NULL;
	good &= !star || (l->rest = pm_zalloc(l->size, sizeof(double)));
	l->u = pm_zalloc(l->size, sizeof(double));
	l->f = pm_zalloc(l->size, sizeof(double));
	l->r = pm_zalloc(l->size, sizeof(double));
	return good && l->u && l->f && l->r;
}

void pm_mgv_free(struct mgv_level *l)
{
	for (int o = 0; o < mgv_neighbours; o++)
		pm_free(l->w[o]);
	for (int e = 0; e < mgv_parents; e++)
		pm_free(l->p[e]);
	pm_free(l->rest), pm_free(l->u), pm_free(l->f), pm_free(l->r), pm_free(l->from);
}

void pm_mgv_ghosts(const struct mgv_level *l, double *a) { pm_mgv_ghosts_wide(l, a, 1); }

void pm_mgv_ghosts_wide(const struct mgv_level *l, double *a, int wide)
{
	const int last = l->dim - 1;
	const struct pm_halo halo = {.from = l->from, .bytes = l->stride[last] * sizeof *a, .wide = wide, .periodic = l->periodic[last], .empty = true};
	for (int d = 0; d < l->dim; d++) {
		if (!l->periodic[d] || (l->from && d == last))
			continue;
		size_t s = l->stride[d], n = l->m[d], block = s * (n + 2); /* along d: ghost, n values, ghost */
		#pragma omp parallel for num_threads(pm_threads()) if (l->size / (n + 2) > mgv_parallel)
		for (size_t b = 0; b < l->size; b += block) {
			memcpy(a + b, a + b + n * s, s * sizeof *a);
			memcpy(a + b + (n + 1) * s, a + b + s, s * sizeof *a);
		}
	}
	if (l->from)
		*l->status = pm_world_halo(*l->status, &halo, a + (size_t)l->beyond * l->stride[last]);
}

static size_t first(const struct pm_grid *g, int d) { return g->face[d][0] == PM_WALL; }

/* Half a volume for each neumann face of the node but along axis `but`. */
static double halves(const struct pm_grid *g, const size_t at[3], int but)
{
	double half = 1;
	for (int d = 0; d < g->dim; d++)
		if (d != but && g->face[d][0] != PM_PERIODIC && (at[d] == 0 || at[d] + 1 == g->points[d]))
			half *= 0.5;
	return half;
}

/* The weights of one node; at: its point in the grid; v->eps has planes beside those here where there are other ranks. */
static void assemble(const struct pm_mg_variable *v, const size_t at[3], size_t place)
{
	const struct mgv_level *l = &v->level[0];
	const struct pm_grid *g = &v->grid;
	const size_t step[3] = {1, g->points[0], g->points[0] * g->points[1]};
	const size_t here = at[0] + at[1] * step[1] + at[2] * step[2] - v->planes.first * v->planes.size;
	const double *eps = v->eps + (v->planes.divided ? v->planes.size : 0);
	for (int o = 1; o < l->n; o++) {
		int d = l->shift[o][0] ? 0 : l->shift[o][1] ? 1 : 2;
		bool up = l->shift[o][d] > 0;
		size_t there = here;
		if (l->periodic[d] && g->points[d] == 1)
			continue; /* nothing varies along this axis */
		if ((up ? at[d] + 1 < g->points[d] : at[d] > 0) || (l->from && l->periodic[d] && d == l->dim - 1))
			there = up ? here + step[d] : here - step[d];
		else if (l->periodic[d])
			there = up ? here - at[d] * step[d] : here + (g->points[d] - 1) * step[d];
		else
			continue; /* beyond a neumann face */
		size_t i = up ? at[d] + 1 : at[d] - 1;
		double e = pm_mg_face(v->mean, eps[(ptrdiff_t)here], eps[(ptrdiff_t)there]) / (g->h[d] * g->h[d]) * halves(g, at, d);
		bool wall = !l->periodic[d] && ((i == 0 && g->face[d][0] == PM_WALL) || (i + 1 == g->points[d] && g->face[d][1] == PM_WALL));
		l->w[0][place] += e;
		*(wall ? &l->rest[place] : &l->w[o][place]) += wall ? e : -e;
	}
}

/* The unknowns of every rank; those on walls are left out. */
static bool divide(struct pm_mg_variable *v)
{
	struct mgv_level *l = &v->level[0];
	const size_t ranks = (size_t)pm_world_size(), wall = first(&v->grid, l->dim - 1), all = l->all[l->dim - 1];
	l->status = &v->status;
	if (!v->planes.divided)
		return true;
	if (!(l->from = pm_alloc(ranks + 1, sizeof *l->from)))
		return false;
	for (size_t r = 0; r <= ranks; r++) {
		const size_t at = v->planes.from[r] > wall ? (size_t)v->planes.from[r] - wall : 0;
		l->from[r] = at < all ? at : all;
	}
	return true;
}

int pm_mgv_finest(struct pm_mg_variable *v)
{
	struct mgv_level *l = &v->level[0];
	const struct pm_grid *g = &v->grid;
	l->dim = g->dim;
	for (int d = 0; d < 3; d++) {
		l->periodic[d] = g->face[d][0] == PM_PERIODIC;
		l->h[d] = g->h[d];
		l->start[d] = first(g, d);
		l->all[d] = g->points[d] - (g->face[d][0] == PM_WALL) - (g->face[d][1] == PM_WALL);
		v->fixed |= g->face[d][0] == PM_WALL || g->face[d][1] == PM_WALL;
	}
	if (!mgv_total(l))
		return 0;
	if (!divide(v) || !pm_mgv_alloc(l, true))
		return -PM_DATA;
	#pragma omp parallel for num_threads(pm_threads()) if (mgv_unknowns(l) > mgv_parallel)
	for (size_t row = 0; row < mgv_rows(l); row++) {
		size_t at[3];
		mgv_at(l, row, at);
		for (size_t i = 0; i < l->m[0]; i++)
			assemble(v, (size_t[]){i + first(g, 0), at[1] + first(g, 1), at[2] + first(g, 2)}, mgv_row(l, row) + i);
	}
	return 0;
}

/* The point of an unknown among those here. */
static size_t point(const struct pm_mg_variable *v, const size_t at[3])
{
	const size_t *n = v->grid.points;
	return at[0] + n[0] * (at[1] + n[1] * at[2]) - v->planes.first * v->planes.size;
}

void pm_mgv_load(const struct pm_mg_variable *v, double c, double average, const double *s, double *f)
{
	const struct mgv_level *l = &v->level[0];
	const struct pm_grid *g = &v->grid;
	#pragma omp parallel for num_threads(pm_threads()) if (mgv_unknowns(l) > mgv_parallel)
	for (size_t row = 0; row < mgv_rows(l); row++) {
		size_t at[3];
		mgv_at(l, row, at);
		at[1] += first(g, 1), at[2] += first(g, 2);
		for (size_t i = 0; i < l->m[0]; i++) {
			at[0] = i + first(g, 0);
			f[mgv_row(l, row) + i] = -c * (s[point(v, at)] - average) * halves(g, at, -1);
		}
	}
}

void pm_mgv_store(const struct pm_mg_variable *v, double factor, const double *u, double *phi)
{
	const struct mgv_level *l = &v->level[0];
	const struct pm_grid *g = &v->grid;
	memset(phi, 0, v->planes.here * v->planes.size * sizeof *phi);
	#pragma omp parallel for num_threads(pm_threads()) if (mgv_unknowns(l) > mgv_parallel)
	for (size_t row = 0; row < mgv_rows(l); row++) {
		size_t at[3];
		mgv_at(l, row, at);
		at[0] = first(g, 0), at[1] += first(g, 1), at[2] += first(g, 2);
		for (size_t i = 0; i < l->m[0]; i++)
			phi[point(v, at) + i] = factor * u[mgv_row(l, row) + i];
	}
}
