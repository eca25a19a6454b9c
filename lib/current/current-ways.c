/* The ways of particles through one step, x to x + v dt, as push moves and folds them. Most are one straight piece. One that is longer than a cell on an axis
 * is cut into equal pieces (Villasenor and Buneman's: at each face of a cell it passes); one that meets a reflecting face is cut there and goes on mirrored.
 * At an absorbing face a particle ends on a wall, where its image takes its charge, and goes on through an open one until its kernel is off the mesh. Beyond
 * an open face a piece is cut off where the kernel no longer touches the mesh. One that starts beyond an absorbing face (inject) comes in the same way:
 * its way through the step begins at the face.
 * Cost: one pass; pieces beyond the first are made by one thread. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "current/current-parts.h"
#include "transfer/transfer-axis.h"

/* One particle on its way. */
struct walker {
	const struct pm_current *c;
	double room[3][2];         /* [length] beyond each face where the kernel no longer touches the mesh */
	double p[3], to[3], speed[3], q, left; /* left: part of the step */
	struct pm_ways *w;         /* NULL: pieces are counted only */
	size_t place, next, pieces;
};

static void emit(struct walker *k, const double end[3], double part)
{
	const struct pm_current *c = k->c;
	const int dim = c->grid.dim;
	const size_t at = k->pieces++ ? k->next++ : k->place;
	if (!k->w)
		return;
	for (int d = 0; d < dim; d++) {
		double a = k->p[d], b = end[d];
		if (c->grid.face[d][0] != PM_PERIODIC) {
			const double low = c->grid.lo[d] - k->room[d][0], high = c->grid.lo[d] + (double)c->grid.cells[d] * c->grid.h[d] + k->room[d][1];
			a = fmin(fmax(a, low), high);
			b = fmin(fmax(b, low), high);
		}
		k->w->at[d][at] = a;
		k->w->way[d][at] = (b - a) / c->grid.h[d];
	}
	k->w->q[at] = k->q;
	for (int d = dim; d < 3; d++)
		k->w->along[d][at] = k->q * k->speed[d] * part;
}

/* The part of what is left of the way at which it is cut next; *axis is that of a face of the box, else -1. */
static double next_cut(const struct walker *k, int *axis, int *side)
{
	const struct pm_current *c = k->c;
	double part = 1;
	*axis = -1;
	for (int d = 0; d < c->grid.dim; d++) {
		const double way = k->to[d] - k->p[d], cells = fabs(way) / c->grid.h[d];
		if (cells > 1)
			part = fmin(part, 1 / ceil(cells));
		if (c->deposit == PM_VILLASENOR_BUNEMAN && way != 0) {
			const double u = (k->p[d] - c->grid.lo[d]) / c->grid.h[d], face = way > 0 ? floor(u + 1e-12) + 1 : ceil(u - 1e-12) - 1;
			part = fmin(part, (face - u) * c->grid.h[d] / way);
		}
	}
	for (int d = 0; d < c->grid.dim; d++)
		for (int s = 0; s < 2; s++) {
			const bool stops = c->face[d][s] == PM_PREFLECT || c->face[d][s] == PM_PABSORB;
			const double face = s ? c->hi[d] : c->lo[d];
			if (!stops || !(s ? k->to[d] > face : k->to[d] < face))
				continue;
			const double here = (face - k->p[d]) / (k->to[d] - k->p[d]), cut = fmin(fmax(here, 0), 1);
			if (cut <= part) {
				part = cut;
				*axis = d, *side = s;
			}
		}
	return part;
}

/* Straight on through an open face until the kernel is off the mesh, at no time. */
static void leave(struct walker *k, int d, int side)
{
	const double h = k->c->grid.h[d];
	for (double gone = 0; gone < k->room[d][side]; gone += h) {
		double end[3] = {k->p[0], k->p[1], k->p[2]};
		end[d] += side ? h : -h;
		emit(k, end, 0);
		k->p[d] = end[d];
	}
}

/* From where the kernel is off the mesh to an absorbing face beyond which the particle starts, at no time; the rest of its way begins there. */
static void enter(struct walker *k)
{
	const struct pm_current *c = k->c;
	for (int d = 0; d < c->grid.dim; d++)
		for (int s = 0; s < 2; s++) {
			const double face = s ? c->hi[d] : c->lo[d], h = c->grid.h[d], part = (face - k->p[d]) / (k->to[d] - k->p[d]);
			if (c->face[d][s] != PM_PABSORB || !(s ? k->p[d] > face && k->to[d] < face : k->p[d] < face && k->to[d] > face))
				continue;
			for (int e = 0; e < c->grid.dim; e++)
				k->p[e] += part * (k->to[e] - k->p[e]);
			k->left *= 1 - part;
			for (double away = k->room[d][s]; away > 0; away -= h) {
				double end[3] = {k->p[0], k->p[1], k->p[2]};
				k->p[d] = s ? face + away : face - away;
				end[d] = s ? k->p[d] - h : k->p[d] + h;
				emit(k, end, 0);
			}
			k->p[d] = face;
		}
}

static void walk(struct walker *k)
{
	const struct pm_current *c = k->c;
	k->left = 1;
	k->pieces = 0;
	enter(k);
	for (int guard = 0; guard < 1 << 24; guard++) {
		int axis, side = 0;
		double end[3] = {0};
		const double part = next_cut(k, &axis, &side);
		for (int d = 0; d < c->grid.dim; d++)
			end[d] = part == 1 ? k->to[d] : k->p[d] + part * (k->to[d] - k->p[d]);
		if (axis >= 0)
			end[axis] = side ? c->hi[axis] : c->lo[axis];
		emit(k, end, part * k->left);
		memcpy(k->p, end, sizeof end);
		k->left *= 1 - part;
		if (axis >= 0 && c->face[axis][side] == PM_PABSORB) {
			leave(k, axis, side);
			return;
		}
		if (axis >= 0)
			k->to[axis] = end[axis] + (end[axis] - k->to[axis]);
		else if (part == 1)
			return;
	}
}

static void start(struct walker *k, size_t p, const double *const x[3], const double *const v[3])
{
	const int dim = k->c->grid.dim;
	for (int d = 0; d < 3; d++)
		k->speed[d] = v[d] ? v[d][p] : 0;
	for (int d = 0; d < dim; d++) {
		k->p[d] = x[d][p];
		k->to[d] = x[d][p] + k->c->dt * k->speed[d];
	}
	k->place = p;
}

enum { together = 512 }; /* particles: their ways are looked at axis by axis, eight at a time */

/* bent[i] |= the way of particle i is more than one piece, by what it does along axis d. */
static void mark_bent(const struct pm_current *c, int d, size_t n, const double *x, const double *v, unsigned char *bent)
{
	const bool shut = c->grid.face[d][0] != PM_PERIODIC, cut = c->deposit == PM_VILLASENOR_BUNEMAN;
	const double least = shut ? c->lo[d] : -INFINITY, most = shut ? c->hi[d] : INFINITY, h = c->grid.h[d], dt = c->dt;
	for (size_t p = 0; p < n; p++) {
		const double a = x[p], b = a + dt * v[p], low = a < b ? a : b, high = a < b ? b : a;
		bent[p] |= !(high - low <= h) | !(low >= least) | !(high <= most);
	}
	for (size_t p = 0; p < n && cut; p++) {
		const double a = x[p], b = a + dt * v[p], from = c->grid.lo[d];
		bent[p] |= floor((a - from) / h) != floor((b - from) / h);
	}
}

/* Marks of the m particles from p on; how many are bent. */
static size_t find_bent(const struct pm_current *c, size_t p, size_t m, const struct pm_column x[3], const struct pm_column v[3], unsigned char bent[together])
{
	double few[2][together];
	size_t many = 0;
	memset(bent, 0, m);
	for (int d = 0; d < c->grid.dim; d++)
		mark_bent(c, d, m, pm_column_take(&x[d], p, m, few[0]), pm_column_take(&v[d], p, m, few[1]), bent);
	for (size_t i = 0; i < m; i++)
		many += bent[i];
	return many;
}

/* The arrays for n pieces in one block. */
int pm_ways_new(struct pm_ways *w, int dim, size_t n)
{
	w->n = n;
	double *next = w->memory = pm_alloc(n * (size_t)(2 * dim + 1 + 3 - dim) + 1, sizeof *w->memory);
	if (!next)
		return -PM_DATA;
	for (int d = 0; d < 3; d++) {
		w->at[d] = d < dim ? next : NULL, next += d < dim ? n : 0;
		w->way[d] = d < dim ? next : NULL, next += d < dim ? n : 0;
		w->along[d] = d < dim ? NULL : next, next += d < dim ? 0 : n;
	}
	w->q = next;
	return 0;
}

/* The way of every particle as one piece. */
static void lay_out(const struct pm_current *c, size_t n, const double *const x[3], const double *const v[3], const double *q, struct pm_ways *w)
{
#pragma omp parallel for schedule(static) if (n > 16384)
	for (size_t from = 0; from < n; from += together) {
		const size_t end = n - from < together ? n : from + together;
		for (int d = 0; d < c->grid.dim; d++) {
			memcpy(w->at[d] + from, x[d] + from, (end - from) * sizeof *x[d]);
			if (v[d])
				pm_tile_ways(c->dt, c->grid.h[d], end - from, x[d] + from, v[d] + from, w->way[d] + from);
			else
				memset(w->way[d] + from, 0, (end - from) * sizeof *w->way[d]);
		}
		memcpy(w->q + from, q + from, (end - from) * sizeof *q);
		for (int d = c->grid.dim; d < 3; d++)
			for (size_t p = from; p < end; p++)
				w->along[d][p] = v[d] ? q[p] * v[d][p] : 0;
	}
}

/* Walks along every way that is bent, with charges q if these are given; returns the further pieces. */
static size_t walk_bent(struct walker *k, size_t n, const double *const x[3], const double *const v[3], const double *q)
{
	struct pm_column at[3], along[3];
	unsigned char bent[together];
	size_t more = 0;
	pm_columns_of(k->c->grid.dim, x, at), pm_columns_of(3, v, along);
	for (size_t p = 0; p < n; p++) {
		if (p % together == 0)
			find_bent(k->c, p, n - p < together ? n - p : together, at, along, bent);
		if (!bent[p % together])
			continue;
		start(k, p, x, v);
		k->q = q ? q[p] : 0;
		walk(k);
		more += k->pieces - 1;
	}
	return more;
}

static size_t count_bent(const struct pm_current *c, size_t n, const struct pm_column x[3], const struct pm_column v[3])
{
	size_t many = 0;
#pragma omp parallel for schedule(static) reduction(+ : many) if (n > 16384)
	for (size_t p = 0; p < n; p += together) {
		unsigned char bent[together];
		many += find_bent(c, p, n - p < together ? n - p : together, x, v, bent);
	}
	return many;
}

bool pm_ways_straight(const struct pm_current *c, size_t n, const struct pm_column x[3], const struct pm_column v[3]) { return !count_bent(c, n, x, v); }

int pm_ways_init(struct pm_ways *w, const struct pm_current *c, size_t n, const double *const x[3], const double *const v[3], const double *q)
{
	struct walker k = {.c = c};
	*w = (struct pm_ways){.n = 0};
	for (int d = 0; d < c->grid.dim; d++) {
		size_t beyond[2];
		pm_axis_path_room(&c->grid, d, c->kernel->width, beyond);
		for (int s = 0; s < 2; s++)
			k.room[d][s] = (double)beyond[s] * c->grid.h[d];
	}
	struct pm_column start_of[3], along[3];
	pm_columns_of(c->grid.dim, x, start_of), pm_columns_of(3, v, along);
	const size_t many = count_bent(c, n, start_of, along);
	if (pm_ways_new(w, c->grid.dim, n + (many ? walk_bent(&k, n, x, v, NULL) : 0)))
		return -PM_DATA;
	lay_out(c, n, x, v, q, w);
	k.w = w;
	k.next = n;
	if (many)
		walk_bent(&k, n, x, v, q);
	return 0;
}

void pm_ways_free(struct pm_ways *w) { w->memory = pm_free(w->memory); }
