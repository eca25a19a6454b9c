/* Cycles of multigrid with a variable coefficient: relaxation by colours, transfers by the weights of the operator.
 *   u += omega (f - M u)/D node by node of a colour;  f_c = P^T r;  u += P u_c
 * Colours: the parity of i+j+k (red-black) on the finest grid, where a node has six neighbours; elsewhere, and with four colours, the parities of i, j, k
 * one by one: four in 2-D, eight in 3-D. Where an odd number of nodes is periodic, the last one is a colour of its own. After the coarse grid the colours
 * come in reverse, which makes the cycle a symmetric preconditioner; of cycles alone all sweeps end with the nodes
 * between coarse ones. Cost: about 30 operations per node, sweep and neighbour of ten.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-variable-level.h"

#include <string.h>

enum { colours_most = 64 };

struct colour {
	bool checker;     /* parity of the sum, or of each index */
	int parity;       /* 0, 1; or bits */
	size_t from[3], to[3];
};

static int colours(const struct mgv_level *l, bool checker, struct colour *c)
{
	int n = 0, seams = 0;
	for (int d = 0; d < l->dim; d++)
		seams |= (l->periodic[d] && l->all[d] > 1 && l->all[d] % 2) << d;
	for (int seam = 0; seam < 1 << l->dim; seam++) {
		if (seam & ~seams)
			continue;
		for (int parity = 0; parity < (checker ? 2 : 1 << l->dim); parity++, n++) {
			c[n] = (struct colour){.checker = checker, .parity = parity};
			for (int d = 0; d < 3; d++) {
				c[n].from[d] = seam >> d & 1 ? l->all[d] - 1 : 0;
				c[n].to[d] = seam >> d & 1 || !(seams >> d & 1) ? l->all[d] : l->all[d] - 1;
			}
		}
	}
	return n;
}

/* M u at a place; n a constant. */
static inline __attribute__((always_inline)) double times(const struct mgv_level *l, const int n, const double *u, size_t p)
{
	double here = u[p], sum = (l->rest ? l->rest : l->w[0])[p] * here, sub = l->rest ? here : 0;
	for (int o = 1; o < n; o++)
		sum += l->w[o][p] * (u[(ptrdiff_t)p + l->at[o]] - sub);
	return sum;
}

static inline __attribute__((always_inline)) void relax_row(const struct mgv_level *l, const int n, double omega, size_t from, size_t to)
{
	for (size_t p = from; p < to; p += 2)
		l->u[p] += omega * (l->f[p] - times(l, n, l->u, p)) / l->w[0][p];
}

static void relax_colour(const struct mgv_level *l, const struct colour *c, double omega)
{
	#pragma omp parallel for num_threads(pm_threads()) if (mgv_unknowns(l) > mgv_parallel)
	for (size_t row = 0; row < mgv_rows(l); row++) {
		size_t j = row % l->m[1] + l->begin[1], k = row / l->m[1] + l->begin[2], place = mgv_row(l, row), i = c->from[0];
		if (j < c->from[1] || j >= c->to[1] || k < c->from[2] || k >= c->to[2])
			continue;
		if (!c->checker && ((int)(j & 1) != (c->parity >> 1 & 1) || (int)(k & 1) != (c->parity >> 2 & 1)))
			continue;
		i += (i + (c->checker ? j + k : 0) + (size_t)(c->parity & 1)) & 1;
		if (l->n == 7)
			relax_row(l, 7, omega, place + i, place + c->to[0]);
		else if (l->n == 27)
			relax_row(l, 27, omega, place + i, place + c->to[0]);
		else if (l->n == 9)
			relax_row(l, 9, omega, place + i, place + c->to[0]);
		else
			relax_row(l, l->n, omega, place + i, place + c->to[0]);
	}
	pm_mgv_ghosts(l, l->u);
}

static inline __attribute__((always_inline)) void residual_row(const struct mgv_level *l, const int n, const double *u, const double *f, double *r, size_t from)
{
	for (size_t p = from; p < from + l->m[0]; p++)
		r[p] = f[p] - times(l, n, u, p);
}

void pm_mgv_residual(const struct mgv_level *l, const double *u, const double *f, double *r)
{
	#pragma omp parallel for num_threads(pm_threads()) if (mgv_unknowns(l) > mgv_parallel)
	for (size_t row = 0; row < mgv_rows(l); row++)
		if (l->n == 7)
			residual_row(l, 7, u, f, r, mgv_row(l, row));
		else if (l->n == 27)
			residual_row(l, 27, u, f, r, mgv_row(l, row));
		else
			residual_row(l, l->n, u, f, r, mgv_row(l, row));
}

static void jacobi(const struct mgv_level *l, double omega)
{
	pm_mgv_residual(l, l->u, l->f, l->r);
	#pragma omp parallel for num_threads(pm_threads()) if (mgv_unknowns(l) > mgv_parallel)
	for (size_t row = 0; row < mgv_rows(l); row++)
		for (size_t p = mgv_row(l, row); p < mgv_row(l, row) + l->m[0]; p++)
			l->u[p] += omega * l->r[p] / l->w[0][p];
	pm_mgv_ghosts(l, l->u);
}

static void smooth(const struct mgv_level *l, const struct pm_mg_choice *o, int sweeps, bool reverse)
{
	struct colour c[colours_most];
	int n = colours(l, l->n == 2 * l->dim + 1 && o->smoother != PM_MG_FOUR_COLOUR, c);
	for (int s = 0; s < sweeps; s++)
		if (o->smoother == PM_MG_JACOBI)
			jacobi(l, o->relaxation);
		else
			for (int q = 0; q < n; q++)
				relax_colour(l, &c[reverse ? n - 1 - q : q], o->relaxation);
}

/* Does coarse node C have a child at s along axis d? The ghost beyond an odd periodic axis is none: it is coarse itself. */
static bool child(const struct mgv_level *f, const struct mgv_level *c, int d, size_t C, int s)
{
	if (s == 0)
		return true;
	if (!f->halved[d])
		return false;
	return !(f->periodic[d] && f->all[d] % 2 && (s < 0 ? C == 0 : C + 1 == c->all[d]));
}

/* f_c = P^T r */
static void restriction(const struct mgv_level *f, const struct mgv_level *c, double *r)
{
	pm_mgv_ghosts(f, r);
	#pragma omp parallel for num_threads(pm_threads()) if (mgv_unknowns(f) > mgv_parallel)
	for (size_t row = 0; row < mgv_rows(c); row++) {
		size_t C[3], at = mgv_row(c, row), base = f->origin;
		mgv_at(c, row, C);
		for (int d = 1; d < 3; d++)
			base += f->stride[d] * ((f->halved[d] ? f->start[d] + 2 * C[d] : C[d]) - f->begin[d]);
		memset(c->f + at, 0, c->m[0] * sizeof(double));
		for (int o = 0; o < mgv_neighbours; o++) {
			const int s[3] = {o % 3 - 1, o / 3 % 3 - 1, o / 9 - 1};
			if (!child(f, c, 1, C[1], s[1]) || !child(f, c, 2, C[2], s[2]))
				continue;
			const double *p = f->p[(s[0] < 0) | (s[1] < 0) << 1 | (s[2] < 0) << 2];
			ptrdiff_t from = (ptrdiff_t)base + s[0] + s[1] * (ptrdiff_t)f->stride[1] + s[2] * (ptrdiff_t)f->stride[2];
			for (C[0] = 0; C[0] < c->m[0]; C[0]++) {
				ptrdiff_t i = from + (ptrdiff_t)(f->halved[0] ? f->start[0] + 2 * C[0] : C[0]);
				if (child(f, c, 0, C[0], s[0]))
					c->f[at + C[0]] += p[i] * r[i];
			}
		}
	}
}

/* The node of an axis of which fine node i is the child, or the lower of the two. */
static ptrdiff_t below(const struct mgv_level *f, int d, size_t i, bool *odd)
{
	*odd = f->halved[d] && ((i + f->start[d]) & 1);
	return f->halved[d] ? ((ptrdiff_t)i - (ptrdiff_t)f->start[d] + 1 + *odd) / 2 - *odd : (ptrdiff_t)i;
}

/* u += P u_c */
static void correct(const struct mgv_level *f, const struct mgv_level *c)
{
	#pragma omp parallel for num_threads(pm_threads()) if (mgv_unknowns(f) > mgv_parallel)
	for (size_t row = 0; row < mgv_rows(f); row++) {
		bool odd[3];
		ptrdiff_t y = below(f, 1, row % f->m[1] + f->begin[1], &odd[1]) - (ptrdiff_t)c->begin[1];
		ptrdiff_t z = below(f, 2, row / f->m[1] + f->begin[2], &odd[2]) - (ptrdiff_t)c->begin[2];
		const double *base = c->u + (ptrdiff_t)c->origin + y * (ptrdiff_t)c->stride[1] + z * (ptrdiff_t)c->stride[2];
		size_t at = mgv_row(f, row);
		for (size_t i = 0; i < f->m[0]; i++) {
			ptrdiff_t x = below(f, 0, i, &odd[0]);
			int kind = odd[0] | odd[1] << 1 | odd[2] << 2;
			double sum = 0;
			for (int e = 0; e < mgv_parents; e++)
				if (!(e & ~kind))
					sum += f->p[e][at + i] *
						base[x + (e & 1) + (e >> 1 & 1) * (ptrdiff_t)c->stride[1] + (e >> 2) * (ptrdiff_t)c->stride[2]];
			f->u[at + i] += sum;
		}
	}
	pm_mgv_ghosts(f, f->u);
}

/* One unknown; of a singular problem any constant will do. */
static void solve_coarsest(const struct pm_mg_variable *v)
{
	const struct mgv_level *l = &v->level[v->levels - 1];
	size_t p = l->origin;
	if (mgv_unknowns(l)) /* of one rank */
		l->u[p] = v->fixed ? l->f[p] / l->w[0][p] : 0;
	pm_mgv_ghosts(l, l->u);
}

void pm_mgv_cycle(struct pm_mg_variable *v, int at, const struct pm_mg_choice *o, bool zero)
{
	struct mgv_level *l = &v->level[at];
	if (at + 1 == v->levels) {
		solve_coarsest(v);
		return;
	}
	if (zero)
		memset(l->u, 0, l->size * sizeof(double));
	smooth(l, o, o->pre, o->plain);
	pm_mgv_residual(l, l->u, l->f, l->r);
	restriction(l, l + 1, l->r);
	pm_mgv_cycle(v, at + 1, o, true);
	if (o->cycle == PM_MG_W)
		pm_mgv_cycle(v, at + 1, o, false);
	correct(l, l + 1);
	smooth(l, o, o->post, true);
}

void pm_mgv_full(struct pm_mg_variable *v, const struct pm_mg_choice *o)
{
	for (int at = 0; at + 1 < v->levels; at++)
		restriction(&v->level[at], &v->level[at + 1], v->level[at].f);
	solve_coarsest(v);
	for (int at = v->levels - 2; at >= 0; at--) {
		memset(v->level[at].u, 0, v->level[at].size * sizeof(double));
		correct(&v->level[at], &v->level[at + 1]);
		if (at)
			pm_mgv_cycle(v, at, o, false);
	}
}
