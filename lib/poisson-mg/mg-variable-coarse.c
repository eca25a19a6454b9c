/* Coarser grids for a variable coefficient: interpolation that follows the operator, and Galerkin matrices.
 *   a node between coarse ones takes the value that satisfies its own equation, the weights of the axes on which it is coarse summed up;
 *   nodes on edges first, then on faces, then in the middle of coarse cells; A_c = P^T A P
 * so that eps grad u, not grad u, is carried across a jump (Alcouffe, Brandt, Dendy, Painter 1981; Dendy 1982; Trottenberg, Oosterlee, Schueller 2001,
 * section 7.7.3). Coarse nodes are every second unknown, the first behind a wall or the one on a neumann face; what is left at the end of an odd axis has one
 * parent. Axes are coarsened where their spacing is within sqrt 2 of the smallest. Constants are interpolated exactly. Cost: 4000 operations per coarse node
 * in 3-D, once. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-variable-level.h"

#include <string.h>

static bool halves(const struct mgv_level *l, int d) { return d < l->dim && l->m[d] > 1; }

/* Is unknown i between coarse ones along axis d? */
static bool between(const struct mgv_level *l, int d, size_t i) { return l->halved[d] && ((i + l->start[d]) & 1); }

/* The unknown one step along from i, folded; false if there is none. */
static bool step(const struct mgv_level *l, int d, size_t i, int s, size_t *to)
{
	*to = i + (size_t)(ptrdiff_t)s;
	if (s == 0 || (s > 0 ? i + 1 < l->m[d] : i > 0))
		return true;
	*to = s > 0 ? 0 : l->m[d] - 1;
	return l->periodic[d];
}

static size_t place(const struct mgv_level *l, const size_t at[3]) { return l->origin + at[0] + at[1] * l->stride[1] + at[2] * l->stride[2]; }

/* The weights of one node from those of the nodes it lies between; odd: bits of its axes that lie between. */
static void weigh(const struct mgv_level *l, const size_t at[3], unsigned odd)
{
	size_t here = place(l, at);
	double middle = 0, w[mgv_parents] = {0};
	for (int o = 0; o < l->n; o++) {
		double a = l->w[o][here];
		size_t to[3];
		unsigned left = odd, up = 0;
		bool there = true;
		for (int d = 0; d < 3; d++) {
			int s = odd >> d & 1 ? l->shift[o][d] : 0;
			there &= step(l, d, at[d], s, &to[d]);
			left &= s ? ~(1u << d) : ~0u;
			up |= (unsigned)(s > 0) << d;
		}
		if (left == odd)
			middle += a;
		for (unsigned e = 0; e < mgv_parents && left != odd && there && a != 0; e++)
			if (!(e & ~odd) && (e & odd & ~left) == up)
				w[e] -= a * l->p[e & left][place(l, to)];
	}
	for (unsigned e = 0; e < 1u << l->dim; e++)
		l->p[e][here] = middle > 0 ? w[e] / middle : 0;
}

/* All nodes of one kind. */
static void weigh_all(const struct mgv_level *l, unsigned odd)
{
	#pragma omp parallel for num_threads(pm_threads()) if (mgv_unknowns(l) > mgv_parallel)
	for (size_t row = 0; row < mgv_rows(l); row++) {
		size_t at[3] = {0, row % l->m[1], row / l->m[1]};
		for (at[0] = 0; at[0] < l->m[0]; at[0]++) {
			unsigned kind = 0;
			for (int d = 0; d < 3; d++)
				kind |= (unsigned)between(l, d, at[d]) << d;
			if (kind == odd && odd)
				weigh(l, at, odd);
			else if (kind == odd)
				l->p[0][place(l, at)] = 1;
		}
	}
}

static bool interpolation(struct mgv_level *l)
{
	static const unsigned kinds[mgv_parents] = {0, 1, 2, 4, 3, 5, 6, 7}; /* by the number of axes */
	for (int e = 0; e < mgv_parents; e++)
		if (e < 1 << l->dim && !(l->p[e] = pm_zalloc(l->size, sizeof(double))))
			return false;
	for (int e = 0; e < mgv_parents; e++)
		if (kinds[e] < 1u << l->dim)
			weigh_all(l, kinds[e]);
	for (int e = 0; e < 1 << l->dim; e++)
		pm_mgv_ghosts(l, l->p[e]);
	return true;
}

/* The coarse step from node C to the parent of fine unknown i that bit `up` names; false if there is none. */
static bool parent(const struct mgv_level *f, const struct mgv_level *c, int d, size_t C, size_t i, bool up, int *shift)
{
	ptrdiff_t n = (ptrdiff_t)c->m[d], to = (ptrdiff_t)i;
	if (f->halved[d])
		to = ((ptrdiff_t)i - (ptrdiff_t)f->start[d] + 1 + between(f, d, i)) / 2 - between(f, d, i) + up;
	if (!c->periodic[d] && (to < 0 || to >= n))
		return false;
	to -= (ptrdiff_t)C;
	if (c->periodic[d])
		to = n == 1 ? 0 : to > 1 ? to - n : to < -1 ? to + n : to;
	*shift = (int)to;
	return true;
}

/* Adds a times the parents of the fine node `at` to the row of coarse node C. */
static void add(const struct mgv_level *f, const struct mgv_level *c, const size_t C[3], const size_t at[3], double a, double row[mgv_neighbours])
{
	unsigned odd = 0;
	for (int d = 0; d < 3; d++)
		odd |= (unsigned)between(f, d, at[d]) << d;
	for (unsigned e = 0; e < mgv_parents; e++) {
		int s[3];
		bool there = !(e & ~odd);
		for (int d = 0; there && d < 3; d++)
			there = parent(f, c, d, C[d], at[d], e >> d & 1, &s[d]);
		if (there)
			row[(s[0] + 1) + 3 * (s[1] + 1) + 9 * (s[2] + 1)] += a * f->p[e][place(f, at)];
	}
}

/* Where the fine unknown lies `s` from coarse node C along axis d, if C is its parent there. */
static bool child(const struct mgv_level *f, int d, size_t C, int s, size_t *i)
{
	size_t at = f->halved[d] ? f->start[d] + 2 * C : C;
	return (s == 0 || f->halved[d]) && step(f, d, at, s, i) && (s == 0 || between(f, d, *i));
}

/* The row of coarse node C: its fine nodes, their neighbours, and the parents of these. */
static void galerkin(const struct mgv_level *f, const struct mgv_level *c, const size_t C[3])
{
	double row[mgv_neighbours] = {0};
	for (int o = 0; o < mgv_neighbours; o++) {
		const int s[3] = {o % 3 - 1, o / 3 % 3 - 1, o / 9 - 1};
		size_t at[3], to[3];
		unsigned e = 0;
		bool there = true;
		for (int d = 0; d < 3; d++) {
			there = there && child(f, d, C[d], s[d], &at[d]);
			e |= (unsigned)(s[d] < 0) << d; /* a node below has C as the parent above */
		}
		for (int q = 0; there && q < f->n; q++) {
			double a = f->w[q][place(f, at)] * f->p[e][place(f, at)];
			bool inside = a != 0;
			for (int d = 0; d < 3; d++)
				inside = inside && step(f, d, at[d], f->shift[q][d], &to[d]);
			if (inside)
				add(f, c, C, to, a, row);
		}
	}
	for (int q = 0; q < c->n; q++)
		c->w[q][place(c, C)] = row[(c->shift[q][0] + 1) + 3 * (c->shift[q][1] + 1) + 9 * (c->shift[q][2] + 1)];
}

bool pm_mgv_coarser(struct mgv_level *f, struct mgv_level *c, bool *more)
{
	double smallest = INFINITY;
	for (int d = 0; d < 3; d++)
		if (halves(f, d))
			smallest = fmin(smallest, f->h[d]);
	*more = isfinite(smallest);
	if (!*more)
		return true;
	*c = (struct mgv_level){.dim = f->dim};
	for (int d = 0; d < 3; d++) {
		f->halved[d] = halves(f, d) && f->h[d] < 1.42 * smallest;
		c->m[d] = !f->halved[d] ? f->m[d] : (f->m[d] + 1 - f->start[d]) / 2;
		c->h[d] = f->halved[d] ? 2 * f->h[d] : f->h[d];
		c->periodic[d] = f->periodic[d];
		c->start[d] = f->start[d];
	}
	if (!interpolation(f) || !pm_mgv_alloc(c, false))
		return false;
	#pragma omp parallel for num_threads(pm_threads()) if (mgv_unknowns(f) > mgv_parallel)
	for (size_t row = 0; row < mgv_rows(c); row++)
		for (size_t i = 0; i < c->m[0]; i++)
			galerkin(f, c, (size_t[]){i, row % c->m[1], row / c->m[1]});
	return true;
}
