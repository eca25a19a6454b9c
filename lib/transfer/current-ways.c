/* The ways of particles through one step, x to x + v dt, as push moves and folds them. Most are one straight piece. One that is longer than a cell on an axis
 * is cut into equal pieces (Villasenor and Buneman's: at each face of a cell it passes); one that meets a reflecting face is cut there and goes on mirrored.
 * At an absorbing face a particle ends on a wall, where its image takes its charge, and goes on through an open one until its kernel is off the mesh. Beyond
 * an open face a piece is cut off where the kernel no longer touches the mesh.
 * Cost: one pass; pieces beyond the first are made by one thread. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "transfer/current.h"
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
		k->w->at[d][at] = fmin(a, b);
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

static void walk(struct walker *k)
{
	const struct pm_current *c = k->c;
	k->left = 1;
	k->pieces = 0;
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

/* Is the way one piece? */
static bool straight(const struct pm_current *c, size_t p, const double *const x[3], const double *const v[3])
{
	bool one = true;
	for (int d = 0; d < c->grid.dim; d++) {
		const double a = x[d][p], b = a + c->dt * (v[d] ? v[d][p] : 0), low = fmin(a, b), high = fmax(a, b), h = c->grid.h[d];
		one &= high - low <= h;
		if (c->grid.face[d][0] != PM_PERIODIC)
			one &= low >= c->lo[d] && high <= c->hi[d];
		if (c->deposit == PM_VILLASENOR_BUNEMAN)
			one &= floor((low - c->grid.lo[d]) / h) == floor((high - c->grid.lo[d]) / h);
	}
	return one;
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

int pm_ways_init(struct pm_ways *w, const struct pm_current *c, size_t n, const double *const x[3], const double *const v[3], const double *q)
{
	const int dim = c->grid.dim;
	struct walker k = {.c = c};
	size_t many = 0, more = 0;
	*w = (struct pm_ways){.n = 0};
	for (int d = 0; d < dim; d++) {
		size_t beyond[2];
		pm_axis_path_room(&c->grid, d, c->kernel->width, beyond);
		for (int s = 0; s < 2; s++)
			k.room[d][s] = (double)beyond[s] * c->grid.h[d];
	}
#pragma omp parallel for schedule(static) reduction(+ : many) if (n > 16384)
	for (size_t p = 0; p < n; p++)
		many += !straight(c, p, x, v);
	for (size_t p = 0; p < n && many; p++)
		if (!straight(c, p, x, v)) {
			start(&k, p, x, v);
			walk(&k);
			more += k.pieces - 1;
		}
	if (pm_ways_new(w, dim, n + more))
		return -PM_DATA;
#pragma omp parallel for schedule(static) if (n > 16384)
	for (size_t p = 0; p < n; p++) {
		for (int d = 0; d < dim; d++) {
			const double a = x[d][p], b = a + c->dt * (v[d] ? v[d][p] : 0);
			w->at[d][p] = fmin(a, b);
			w->way[d][p] = (b - a) / c->grid.h[d];
		}
		w->q[p] = q[p];
		for (int d = dim; d < 3; d++)
			w->along[d][p] = v[d] ? q[p] * v[d][p] : 0;
	}
	k.w = w;
	k.next = n;
	for (size_t p = 0; p < n && many; p++)
		if (!straight(c, p, x, v)) {
			start(&k, p, x, v);
			k.q = q[p];
			walk(&k);
		}
	return 0;
}

void pm_ways_free(struct pm_ways *w) { w->memory = pm_free(w->memory); }
