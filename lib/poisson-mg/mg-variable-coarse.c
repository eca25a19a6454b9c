/* Coarser grids for a variable coefficient: interpolation that follows the operator, and Galerkin matrices.
 *   a node between coarse ones takes the value that satisfies its own equation, the weights of the axes on which it is coarse summed up;
 *   nodes on edges first, then on faces, then in the middle of coarse cells; A_c = P^T A P
 * so that eps grad u, not grad u, is carried across a jump (Alcouffe, Brandt, Dendy, Painter 1981; Dendy 1982; Trottenberg, Oosterlee, Schueller 2001,
 * section 7.7.3). Coarse nodes are every second unknown, the first behind a wall or the one on a neumann face; what is left at the end of an odd axis has one
 * parent. Axes are coarsened where their spacing is within sqrt 2 of the smallest. Constants are interpolated exactly. Cost: 4000 operations per coarse node
 * in 3-D, once. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-variable-level.h"
#include "world/world.h"

#include <string.h>

/* An unknown of the mesh, and where it is stored, counted from the first one here: in a plane of ghosts where it belongs to another rank. */
struct node {
	size_t at[3];
	ptrdiff_t where[3];
};

static bool halves(const struct mgv_level *l, int d) { return d < l->dim && l->all[d] > 1; }

/* Is unknown i between coarse ones along axis d? */
static bool between(const struct mgv_level *l, int d, size_t i) { return l->halved[d] && ((i + l->start[d]) & 1); }

/* Goes s steps along, folded; false if there is nothing. */
static bool step(const struct mgv_level *l, int d, int s, struct node *n)
{
	const size_t i = n->at[d];
	const bool inside = s == 0 || (s > 0 ? i + 1 < l->all[d] : i > 0);
	n->at[d] = inside ? i + (size_t)(ptrdiff_t)s : s > 0 ? 0 : l->all[d] - 1;
	n->where[d] = l->from && d == l->dim - 1 ? n->where[d] + s : (ptrdiff_t)n->at[d];
	return inside || l->periodic[d];
}

static size_t place(const struct mgv_level *l, const struct node *n)
{
	return l->origin + (size_t)(n->where[0] + n->where[1] * (ptrdiff_t)l->stride[1] + n->where[2] * (ptrdiff_t)l->stride[2]);
}

static struct node node_of(const struct mgv_level *l, size_t x, size_t y, size_t z)
{
	struct node n = {.at = {x, y, z}};
	for (int d = 0; d < 3; d++)
		n.where[d] = (ptrdiff_t)n.at[d] - (ptrdiff_t)l->begin[d];
	return n;
}

/* The weights of one node from those of the nodes it lies between; odd: bits of its axes that lie between. */
static void weigh(const struct mgv_level *l, const struct node *n, unsigned odd)
{
	const size_t here = place(l, n);
	double middle = 0, w[mgv_parents] = {0};
	for (int o = 0; o < l->n; o++) {
		double a = l->w[o][here];
		struct node to = *n;
		unsigned left = odd, up = 0;
		bool there = true;
		for (int d = 0; d < 3; d++) {
			int s = odd >> d & 1 ? l->shift[o][d] : 0;
			there &= step(l, d, s, &to);
			left &= s ? ~(1u << d) : ~0u;
			up |= (unsigned)(s > 0) << d;
		}
		if (left == odd)
			middle += a;
		for (unsigned e = 0; e < mgv_parents && left != odd && there && a != 0; e++)
			if (!(e & ~odd) && (e & odd & ~left) == up)
				w[e] -= a * l->p[e & left][place(l, &to)];
	}
	for (unsigned e = 0; e < 1u << l->dim; e++)
		l->p[e][here] = middle > 0 ? w[e] / middle : 0;
}

/* All nodes of one kind. */
static void weigh_all(const struct mgv_level *l, unsigned odd)
{
	#pragma omp parallel for num_threads(pm_threads()) if (mgv_unknowns(l) > mgv_parallel)
	for (size_t row = 0; row < mgv_rows(l); row++) {
		size_t at[3];
		mgv_at(l, row, at);
		for (size_t i = 0; i < l->m[0]; i++) {
			const struct node n = node_of(l, i, at[1], at[2]);
			unsigned kind = 0;
			for (int d = 0; d < 3; d++)
				kind |= (unsigned)between(l, d, n.at[d]) << d;
			if (kind == odd && odd)
				weigh(l, &n, odd);
			else if (kind == odd)
				l->p[0][place(l, &n)] = 1;
		}
	}
}

static bool interpolation(struct mgv_level *l)
{
	static const unsigned kinds[mgv_parents] = {0, 1, 2, 4, 3, 5, 6, 7}; /* by the number of axes */
	bool good = true;
	for (int e = 0; e < 1 << l->dim; e++)
		good = (l->p[e] = pm_zalloc(l->size, sizeof(double))) && good;
	if (l->from)
		*l->status = pm_world_agree(good ? *l->status : pm_failed());
	if (!good || *l->status)
		return false;
	for (int k = 0; k < mgv_parents; k++) {
		if (kinds[k] >= 1u << l->dim)
			continue;
		weigh_all(l, kinds[k]);
		for (unsigned e = 0; e <= kinds[k] && l->from; e++)
			if (!(e & ~kinds[k]))
				pm_mgv_ghosts(l, l->p[e]);
	}
	for (int e = 0; e < 1 << l->dim; e++)
		pm_mgv_ghosts_wide(l, l->p[e], l->beyond);
	for (int o = 0; o < l->n && l->from; o++)
		pm_mgv_ghosts(l, l->w[o]);
	return !*l->status;
}

/* The coarse step from node C to the parent of fine unknown i that bit `up` names; false if there is none. */
static bool parent(const struct mgv_level *f, const struct mgv_level *c, int d, size_t C, size_t i, bool up, int *shift)
{
	ptrdiff_t n = (ptrdiff_t)c->all[d], to = (ptrdiff_t)i;
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

/* Adds a times the parents of a fine node to the row of coarse node C. */
static void add(const struct mgv_level *f, const struct mgv_level *c, const size_t C[3], const struct node *n, double a, double row[mgv_neighbours])
{
	unsigned odd = 0;
	for (int d = 0; d < 3; d++)
		odd |= (unsigned)between(f, d, n->at[d]) << d;
	for (unsigned e = 0; e < mgv_parents; e++) {
		int s[3];
		bool there = !(e & ~odd);
		for (int d = 0; there && d < 3; d++)
			there = parent(f, c, d, C[d], n->at[d], e >> d & 1, &s[d]);
		if (there)
			row[(s[0] + 1) + 3 * (s[1] + 1) + 9 * (s[2] + 1)] += a * f->p[e][place(f, n)];
	}
}

/* Goes from coarse node C to the fine unknown that lies `s` from it along axis d; false if C is not its parent there. */
static bool child(const struct mgv_level *f, int d, int s, struct node *n)
{
	return (s == 0 || f->halved[d]) && step(f, d, s, n) && (s == 0 || between(f, d, n->at[d]));
}

/* The row of coarse node C: its fine nodes, their neighbours, and the parents of these. */
static void galerkin(const struct mgv_level *f, const struct mgv_level *c, const size_t C[3])
{
	const struct node middle = node_of(f, f->halved[0] ? f->start[0] + 2 * C[0] : C[0], f->halved[1] ? f->start[1] + 2 * C[1] : C[1],
		f->halved[2] ? f->start[2] + 2 * C[2] : C[2]), coarse = node_of(c, C[0], C[1], C[2]);
	double row[mgv_neighbours] = {0};
	for (int o = 0; o < mgv_neighbours; o++) {
		const int s[3] = {o % 3 - 1, o / 3 % 3 - 1, o / 9 - 1};
		struct node at = middle;
		unsigned e = 0;
		bool there = true;
		for (int d = 0; d < 3; d++) {
			there = there && child(f, d, s[d], &at);
			e |= (unsigned)(s[d] < 0) << d; /* a node below has C as the parent above */
		}
		const size_t from = there ? place(f, &at) : 0;
		for (int q = 0; there && q < f->n; q++) {
			double a = f->w[q][from] * f->p[e][from];
			bool inside = a != 0;
			struct node to = at;
			for (int d = 0; d < 3; d++)
				inside = inside && step(f, d, f->shift[q][d], &to);
			if (inside)
				add(f, c, C, &to, a, row);
		}
	}
	for (int q = 0; q < c->n; q++)
		c->w[q][place(c, &coarse)] = row[(c->shift[q][0] + 1) + 3 * (c->shift[q][1] + 1) + 9 * (c->shift[q][2] + 1)];
}

/* A coarse plane is where the fine one at or below it is: the first coarse plane of every rank. */
static bool divide(const struct mgv_level *f, struct mgv_level *c)
{
	const int last = f->dim - 1;
	const size_t ranks = (size_t)pm_world_size();
	c->status = f->status;
	if (!f->from)
		return true;
	if (!(c->from = pm_alloc(ranks + 1, sizeof *c->from)))
		return false;
	for (size_t r = 0; r <= ranks; r++) {
		const uint64_t at = f->from[r], start = f->start[last];
		c->from[r] = !f->halved[last] ? at : at > start ? (at - start + 1) / 2 : 0;
	}
	return true;
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
		c->all[d] = !f->halved[d] ? f->all[d] : (f->all[d] + 1 - f->start[d]) / 2;
		c->h[d] = f->halved[d] ? 2 * f->h[d] : f->h[d];
		c->periodic[d] = f->periodic[d];
		c->start[d] = f->start[d];
	}
	if (!interpolation(f) || !divide(f, c) || !pm_mgv_alloc(c, false))
		return false;
	#pragma omp parallel for num_threads(pm_threads()) if (mgv_unknowns(f) > mgv_parallel)
	for (size_t row = 0; row < mgv_rows(c); row++) {
		size_t at[3];
		mgv_at(c, row, at);
		for (at[0] = 0; at[0] < c->m[0]; at[0]++)
			galerkin(f, c, at);
	}
	return true;
}
