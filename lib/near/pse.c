/* Particle strength exchange: dG_p/dt = (nu/eps^2) sum_q (V_p G_q - V_q G_p) eta_eps(x_p - x_q), the Laplacian as an exchange between particles.
 * Source: Degond and Mas-Gallic 1989; Eldredge, Leonard, Colonius 2002; the Gaussians of order 2 and 4 have the width exp(-z^2/4) and the transforms
 * exp(-k^2) and (2 + k^2) exp(-k^2), which are positive: so the largest rate of decay is at most the largest sum_q V_q eta_eps(x_p - x_q),
 * which a lattice with eps >= h reaches but for exp(-pi^2). Error O(eps^order) + quadrature, which needs eps >= h and particles that are not
 * distorted. Conserves the sum of G where no wall is. Order 4 has negative weights beyond z^2 = 8 + 2 dim: no maximum principle.
 * Partners come from a cell list, eight at a time; every target sums its own row. Cost: N times the particles within the cut-off, about 30
 * operations for 8 of them. Weak: particles of one cell that see all others cost N^2. SPDX-License-Identifier: GPL-3.0-or-later */
#include "near/pse.h"
#include "base/lanes.h"

struct pm_pse pm_pse_of(int dim, int order, double eps, double cutoff)
{
	struct pm_pse p = {.dim = dim, .order = order, .eps = eps, .cutoff = cutoff, .reach = eps * cutoff * (1 + 1e-9), .constant = 1, .total = 1};
	if (order == 4)
		p.constant = 2 + 0.5 * dim, p.square = -0.25, p.total = 2;
	/* sphere * integral of r^(dim-1) |eta| from the cut-off, by the midpoint rule */
	double sphere = dim == 1 ? 2 : dim == 2 ? 2 * pm_pi : 4 * pm_pi, step = 1.0 / 64;
	for (double r = cutoff + step / 2; r < cutoff + 12; r += step)
		p.beyond += step * sphere * pow(r, dim - 1) * fabs(pm_pse_value(&p, r * r)) / p.total;
	return p;
}

double pm_pse_cutoff(int order) { return order == 4 ? 9 : 8; } /* second moments right to 7e-6 and better (docs/methods/pse.md) */

double pm_pse_value(const struct pm_pse *p, double z2)
{
	return pow(4 * pm_pi, -0.5 * p->dim) * (p->constant + p->square * z2) * exp(-z2 / 4);
}

/* By place in the cell list, padded; and the kernel in terms of r^2. */
struct work {
	const struct pm_cell_list *list;
	double *volume, *strength;
	double reach2, exponent, constant, square, factor; /* eta/eps^2 = factor (constant + square r^2) exp(exponent r^2) */
};

/* One particle as one stretch sees it, and its sums over partners: of (V_p G_q - V_q G_p) eta and of V_q eta, without the factor. */
struct row {
	pm_lanes x[3], shift[3], volume, strength, exchange, weight;
};

/* Eight partners at j; those from the count-th on are not meant. */
PM_LANES_INLINE void meet(const struct work *w, int dim, int order, bool moved, size_t j, size_t count, bool whole, struct row *r)
{
	pm_lanes r2 = {0}, eta, q = pm_lanes_load_any(w->volume + j), g = pm_lanes_load_any(w->strength + j);
	PM_LANES_UNROLL
	for (int d = 0; d < dim; d++) {
		pm_lanes s = r->x[d] - pm_lanes_load_any(w->list->x[d] + j);
		if (moved)
			s += r->shift[d];
		r2 = pm_lanes_fma(s, s, r2);
	}
	if (!whole)
		r2 = pm_lanes_first(count, r2, pm_lanes_all(HUGE_VAL));
	eta = pm_lanes_exp(r2 * pm_lanes_all(w->exponent));
	if (order == 4)
		eta *= pm_lanes_fma(r2, pm_lanes_all(w->square), pm_lanes_all(w->constant));
	eta = pm_lanes_where_not_below(pm_lanes_all(w->reach2), r2, eta);
	r->exchange = pm_lanes_fma(r->volume * g - q * r->strength, eta, r->exchange); /* antisymmetric: no fma within */
	r->weight = pm_lanes_fma(q, eta, r->weight);
}

PM_LANES_INLINE void stretch(const struct work *w, int dim, int order, bool moved, const struct pm_stretch *s, struct row *r)
{
	size_t j = s->from;
	for (; j + PM_VECTOR_LANES <= s->to; j += PM_VECTOR_LANES)
		meet(w, dim, order, moved, j, PM_VECTOR_LANES, true, r);
	if (j < s->to)
		meet(w, dim, order, moved, j, s->to - j, false, r);
}

/* The row of the particle at place i: its sums. */
PM_LANES_INLINE void row(const struct work *w, int dim, int order, size_t i, size_t n, const struct pm_stretch *s, double *exchange, double *weight)
{
	struct row r = {.strength = pm_lanes_all(w->strength[i])};
	for (size_t k = 0; k < n; k++) {
		r.volume = pm_lanes_all(s[k].sign * w->volume[i]); /* instead of the strengths of the images */
		PM_LANES_UNROLL
		for (int d = 0; d < dim; d++) {
			r.x[d] = pm_lanes_all(s[k].side[d] * w->list->x[d][i]);
			r.shift[d] = pm_lanes_all(s[k].shift[d]);
		}
		if (s[k].moved)
			stretch(w, dim, order, true, s + k, &r);
		else
			stretch(w, dim, order, false, s + k, &r);
	}
	*exchange = w->factor * pm_lanes_sum(r.exchange);
	*weight = w->factor * pm_lanes_sum(r.weight);
}

#define ROW(dim, order) \
	static void row_##dim##_##order(const struct work *w, size_t i, size_t n, const struct pm_stretch *s, double *exchange, double *weight) \
	{ \
		row(w, dim, order, i, n, s, exchange, weight); \
	}
ROW(1, 2) ROW(2, 2) ROW(3, 2) ROW(1, 4) ROW(2, 4) ROW(3, 4)
typedef void row_of(const struct work *, size_t, size_t, const struct pm_stretch *, double *, double *);
static row_of *const table[2][3] = {{row_1_2, row_2_2, row_3_2}, {row_1_4, row_2_4, row_3_4}};

/* One cell: rates of its particles, the largest weight, and who is alone. */
static void cell(const struct work *w, row_of *sum, double nu, size_t c, struct pm_stretch *s, double *rate, double *most, uint64_t *alone)
{
	const struct pm_cell_list *l = w->list;
	size_t n = pm_cell_list_around(l, c, s);
	for (size_t i = l->start[c]; i < l->start[c + 1]; i++) {
		double exchange, weight;
		sum(w, i, n, s, &exchange, &weight);
		rate[l->order[i]] += nu * exchange;
		*most = fmax(*most, weight);
		*alone += weight == w->factor * (w->constant * w->volume[i]);
	}
}

/* The largest of a number and a count, over the threads: neither depends on the order. */
static int cells(const struct work *w, row_of *sum, double nu, double *rate, double *most, uint64_t *alone)
{
	const struct pm_cell_list *l = w->list;
	int bad = 0;
	double largest = 0;
	uint64_t count = 0;
#pragma omp parallel if (l->n > 256) reduction(max : largest) reduction(+ : count) reduction(| : bad)
	{
		struct pm_stretch *s = pm_alloc(l->most, sizeof *s);
		bad = !s;
#pragma omp for schedule(dynamic, 16)
		for (size_t c = 0; c < l->occupied; c++)
			if (s)
				cell(w, sum, nu, c, s, rate, &largest, &count);
		pm_free(s);
	}
	*most = largest, *alone = count;
	return bad ? pm_fail(PM_DATA, "out of memory") : 0;
}

static double *by_place(const struct pm_cell_list *l, const double *values)
{
	double *to = pm_alloc(l->n + PM_CELLS_PAD, sizeof *to);
	for (size_t i = 0; to && i < l->n + PM_CELLS_PAD; i++)
		to[i] = i < l->n ? values[l->order[i]] : 0;
	return to;
}

int pm_pse_add(const struct pm_pse *p, const struct pm_cell_list *l, double nu, const double *volume, const double *strength, double *rate,
	struct pm_pse_found *found)
{
	double most = 0, eps2 = p->eps * p->eps;
	struct work w = {.list = l, .volume = by_place(l, volume), .strength = by_place(l, strength), .reach2 = l->reach * l->reach,
		.exponent = -0.25 / eps2, .constant = p->constant, .square = p->square / eps2,
		.factor = pow(4 * pm_pi, -0.5 * p->dim) * pow(p->eps, -p->dim) / eps2};
	int status = w.volume && w.strength ? cells(&w, table[p->order == 4][p->dim - 1], nu, rate, &most, &found->alone) : -PM_DATA;
	found->fastest = most * (1 + p->beyond);
	pm_free(w.volume), pm_free(w.strength);
	return status;
}
