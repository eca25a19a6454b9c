/* Particle strength exchange: dG_p/dt = (nu/eps^2) sum_q (V_p G_q - V_q G_p) eta_eps(x_p - x_q), the Laplacian as an exchange between particles.
 * Source: Degond and Mas-Gallic 1989; Eldredge, Leonard, Colonius 2002; eta(z) = (4 pi)^(-dim/2) L(z^2/4) exp(-z^2/4), L the
 * associated Laguerre polynomial of degree m = order/2 - 1 and parameter dim/2 + 1. Its transform is exp(-s) times the sum of (m + 1 - j) s^j/j!, j <= m,
 * s = k^2, which is positive: so the largest rate of decay is at most the largest sum_q V_q eta_eps(x_p - x_q), which a lattice with eps >= h reaches up
 * to exp(-pi^2). Error O(eps^order) + quadrature, which needs eps >= h and particles that are not distorted. Conserves the sum of G without walls. Above
 * order 2 some weights are negative (order 4: beyond z^2 = 8 + 2 dim): no maximum principle.
 * With a share s of every particle (s_p + s_q)/2 multiplies a pair (Degond and Mas-Gallic 1989): since eta takes a function g to lap g, this is
 * (s lap f + lap(s f) - f lap s)/2 = div(s grad f), with the order of eta. Where eta > 0 no mode decays faster than without; a negative weight that lacks
 * its share adds at most twice itself.
 * Partners come from a cell list, eight at a time for two targets; each pair is taken once for both. Fixed pieces of the work sum on their own and are added in
 * order, on many ranks too (near/pse-ranks.h). Cost: N times half the particles within the cut-off, and two numbers a particle and thread. Weakness: N^2 if
 * all particles are within the cut-off of each other.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "near/pse.h"
#include "base/simd.h"
#include "near/pse-ranks.h"

struct pm_pse pm_pse_of(int dim, int order, double eps, double cutoff)
{
	const int m = order / 2 - 1;
	struct pm_pse p = {.dim = dim, .order = order, .eps = eps, .cutoff = cutoff, .reach = pm_pse_reach(eps, cutoff), .total = m + 1};
	/* L_m(y) = sum_i (-1)^i binomial(m + a, m - i) y^i/i!, a = dim/2 + 1 */
	for (int i = 0; i <= m; i++) {
		double c = i % 2 ? -1 : 1;
		for (int k = 1; k <= m - i; k++)
			c *= (0.5 * dim + 1 + i + k) / k;
		for (int k = 1; k <= i; k++)
			c /= 4.0 * k;
		p.coefficient[i] = c;
	}
	/* sphere * integral of r^(dim-1) |eta| from the cut-off, by the midpoint rule */
	double sphere = dim == 1 ? 2 : dim == 2 ? 2 * pm_pi : 4 * pm_pi, step = 1.0 / 64;
	for (double r = cutoff + step / 2; r < cutoff + 12; r += step)
		p.beyond += step * sphere * pow(r, dim - 1) * fabs(pm_pse_value(&p, r * r)) / p.total;
	for (double r = step / 2; order > 2 && r < cutoff; r += step)
		p.negative += step * sphere * pow(r, dim - 1) * fmax(0, -pm_pse_value(&p, r * r)) / p.total;
	return p;
}

double pm_pse_cutoff(int order) { return 7 + order / 2; } /* second moments right to 7e-6 and better (docs/methods/pse.md) */

double pm_pse_value(const struct pm_pse *p, double z2)
{
	const double *c = p->coefficient;
	return pow(4 * pm_pi, -0.5 * p->dim) * (c[0] + z2 * (c[1] + z2 * (c[2] + z2 * c[3]))) * exp(-z2 / 4);
}

enum { ROWS = 2, PIECE = 4096, SMALL = 16 }; /* targets at a time; places of a piece; below so many pieces a quarter of that, for threads to share */

/* By place in the cell list, padded; and the kernel in terms of r^2. */
struct work {
	const struct pm_cell_list *list;
	double *volume, *strength, *half; /* half: of the share; NULL: none */
	double *exchange, *weight; /* sums over partners of (V_p G_q - V_q G_p) eta and of V_q eta, without the factor */
	double reach2, exponent, coefficient[PM_PSE_TERMS], factor; /* eta/eps^2 = factor sum_i coefficient_i r^2i exp(exponent r^2) */
	struct pm_pse_kept *kept;  /* with ranks: what pieces give, piece after piece; else NULL */
};

/* The contribution of a piece of the work to the sums, nonzero only at the places low..high-1; zero between pieces. */
struct sums {
	size_t low, high;
	double *exchange, *weight;
};

/* The particles of one cell, shifted for one neighbour range, and their sums. */
struct rows {
	pm_simd x[3][ROWS], shift[3], volume[ROWS], strength[ROWS], half[ROWS], exchange[ROWS], weight[ROWS];
};

/* Constants for which the compiler makes a separate loop: rows n at a time; shares; both directions; shifted images. */
struct how {
	int dim, order, n;
	bool shares, half, moved;
};

/* Partners at j..j+7 of n rows, those outside of from..to-1 left out; half: both ways, with the partners' sums at own. */
PM_SIMD_INLINE void meet(const struct work *w, const struct how how, size_t j, bool whole, const size_t from[ROWS], size_t to, struct sums *own, struct rows *r)
{
	const int dim = how.dim, n = how.n;
	const bool half = how.half;
	pm_simd y[3], q = pm_simd_load_any(w->volume + j), g = pm_simd_load_any(w->strength + j), exchange = {0}, weight = {0}, share = {0};
	if (how.shares)
		share = pm_simd_load_any(w->half + j);
	PM_SIMD_UNROLL
	for (int d = 0; d < dim; d++)
		y[d] = pm_simd_load_any(w->list->x[d] + j);
	if (half)
		exchange = pm_simd_load_any(own->exchange + j), weight = pm_simd_load_any(own->weight + j);
	PM_SIMD_UNROLL
	for (int k = 0; k < n; k++) {
		pm_simd r2 = {0}, eta, traded;
		PM_SIMD_UNROLL
		for (int d = 0; d < dim; d++) {
			pm_simd s = r->x[d][k] - y[d];
			if (how.moved)
				s += r->shift[d];
			r2 = pm_simd_fma(s, s, r2);
		}
		if (!whole)
			r2 = pm_simd_between(from[k], to, r2, pm_simd_all(HUGE_VAL));
		eta = pm_simd_exp(r2 * pm_simd_all(w->exponent));
		if (how.order > 2) {
			pm_simd polynomial = pm_simd_all(w->coefficient[how.order / 2 - 1]);
			PM_SIMD_UNROLL
			for (int i = how.order / 2 - 2; i >= 0; i--)
				polynomial = pm_simd_fma(r2, polynomial, pm_simd_all(w->coefficient[i]));
			eta *= polynomial;
		}
		eta = pm_simd_where_not_below(pm_simd_all(w->reach2), r2, eta);
		traded = r->volume[k] * g - q * r->strength[k]; /* antisymmetric: no fma within */
		if (how.shares)
			traded *= r->half[k] + share;
		r->exchange[k] = pm_simd_fma(traded, eta, r->exchange[k]);
		r->weight[k] = pm_simd_fma(q, eta, r->weight[k]);
		if (half)
			exchange = pm_simd_fnma(traded, eta, exchange), weight = pm_simd_fma(r->volume[k], eta, weight);
	}
	if (half)
		pm_simd_store_any(own->exchange + j, exchange), pm_simd_store_any(own->weight + j, weight);
}

/* The partners at from..to-1; first: how many of them each row leaves out. */
PM_SIMD_INLINE void range_sums(const struct work *w, const struct how how, size_t from, size_t to, const size_t first[ROWS], struct sums *own, struct rows *r)
{
	static const size_t none[ROWS] = {0};
	size_t j = from;
	if (how.half && first[how.n - 1] && j < to) {
		meet(w, how, j, false, first, to - j, own, r);
		j += PM_SIMD_WIDTH;
	}
	for (; j + PM_SIMD_WIDTH <= to; j += PM_SIMD_WIDTH)
		meet(w, how, j, true, none, PM_SIMD_WIDTH, own, r);
	if (j < to)
		meet(w, how, j, false, none, to - j, own, r);
}

PM_SIMD_INLINE void rows_see(const struct work *w, int dim, bool shares, int n, size_t i, const struct pm_neighbour_range *s, struct rows *r)
{
	PM_SIMD_UNROLL
	for (int t = 0; t < n; t++) {
		PM_SIMD_UNROLL
		for (int d = 0; d < dim; d++)
			r->x[d][t] = pm_simd_all(s->side[d] * w->list->x[d][i + (size_t)t]);
		r->volume[t] = pm_simd_all(s->sign * w->volume[i + (size_t)t]); /* instead of the strengths of the images */
		r->strength[t] = pm_simd_all(w->strength[i + (size_t)t]);
		if (shares)
			r->half[t] = pm_simd_all(w->half[i + (size_t)t]);
	}
	PM_SIMD_UNROLL
	for (int d = 0; d < dim; d++)
		r->shift[d] = pm_simd_all(s->shift[d]);
}

/* The n particles at place i: pairs with later ones and with images shifted up, in both directions; and contributions of mirror images. */
PM_SIMD_INLINE void rows(const struct work *w, const struct how all, size_t i, size_t ranges, const struct pm_neighbour_range *s, struct sums *own)
{
	const int n = all.n;
	struct rows r = {.exchange = {{0}}};
	struct how how = all;
	static const size_t none[ROWS] = {0}, later[ROWS] = {0, 1};
	for (size_t k = 0; k < ranges; k++) {
		bool here = s[k].kind == PM_HERE;
		size_t from = here && s[k].from < i + 1 ? i + 1 : s[k].from;
		if (from >= s[k].to)
			continue;
		rows_see(w, all.dim, all.shares, n, i, s + k, &r);
		if (here) {
			how.half = true, how.moved = false;
			range_sums(w, how, from, s[k].to, from == i + 1 ? later : none, own, &r);
		} else if (s[k].kind == PM_AHEAD) {
			how.half = true, how.moved = true;
			range_sums(w, how, from, s[k].to, none, own, &r);
		} else {
			how.half = false, how.moved = true;
			range_sums(w, how, from, s[k].to, none, own, &r);
		}
	}
	PM_SIMD_UNROLL
	for (int t = 0; t < n; t++) {
		own->exchange[i + (size_t)t] += pm_simd_sum(r.exchange[t]);
		own->weight[i + (size_t)t] += pm_simd_sum(r.weight[t]);
	}
}

typedef void loop(const struct work *w, size_t i, size_t n, const struct pm_neighbour_range *s, struct sums *own);
struct loops {
	loop *one, *two;
};
#define LOOP(name, dim, order, n, shares) \
	static void name(const struct work *w, size_t i, size_t ranges, const struct pm_neighbour_range *s, struct sums *own) \
	{ \
		rows(w, (struct how){dim, order, n, shares, true, false}, i, ranges, s, own); \
	}
#define LOOPS(dim, order) \
	LOOP(one_##dim##_##order, dim, order, 1, false) LOOP(two_##dim##_##order, dim, order, 2, false) \
	LOOP(one_shares_##dim##_##order, dim, order, 1, true) LOOP(two_shares_##dim##_##order, dim, order, 2, true) \
	static const struct loops loops_##dim##_##order[2] = { \
		{one_##dim##_##order, two_##dim##_##order}, {one_shares_##dim##_##order, two_shares_##dim##_##order}};
LOOPS(1, 2) LOOPS(2, 2) LOOPS(3, 2) LOOPS(1, 4) LOOPS(2, 4) LOOPS(3, 4) LOOPS(1, 6) LOOPS(2, 6) LOOPS(3, 6) LOOPS(1, 8) LOOPS(2, 8) LOOPS(3, 8)
static const struct loops *const table[PM_PSE_TERMS][3] = {
	{loops_1_2, loops_2_2, loops_3_2}, {loops_1_4, loops_2_4, loops_3_4}, {loops_1_6, loops_2_6, loops_3_6}, {loops_1_8, loops_2_8, loops_3_8}};

/* The occupied cell in which a place is. */
static size_t cell_of(const struct pm_cell_list *l, size_t place)
{
	size_t from = 0, to = l->occupied;
	while (to - from > 1) {
		size_t middle = from + (to - from) / 2;
		if (l->start[middle] <= place)
			from = middle;
		else
			to = middle;
	}
	return from;
}

/* The pairs of which the first is at a place from..to-1, with their sums. */
static void piece(const struct work *w, const struct loops *loops, size_t from, size_t to, struct pm_neighbour_range *s, struct sums *own)
{
	const struct pm_cell_list *l = w->list;
	own->low = from, own->high = to;
	for (size_t c = from < to ? cell_of(l, from) : l->occupied; c < l->occupied && l->start[c] < to; c++) {
		size_t n = pm_cell_list_around(l, c, true, s), end = l->start[c + 1] < to ? l->start[c + 1] : to;
		for (size_t k = 0; k < n; k++) {
			own->low = s[k].from < own->low ? s[k].from : own->low;
			own->high = s[k].to > own->high ? s[k].to : own->high;
		}
		for (size_t i = l->start[c] < from ? from : l->start[c]; i < end; i += ROWS)
			(i + 1 < end ? loops->two : loops->one)(w, i, n, s, own);
	}
}

static void take(const struct work *w, struct sums *own)
{
	if (w->kept) {
		pm_pse_keep(w->kept, own->low, own->high, own->exchange, own->weight);
		return;
	}
	for (size_t i = own->low; i < own->high; i++) {
		w->exchange[i] += own->exchange[i], own->exchange[i] = 0;
		w->weight[i] += own->weight[i], own->weight[i] = 0;
	}
}

static size_t piece_size(size_t n) { return n < SMALL * PIECE ? PIECE / 4 : PIECE; }

/* Pieces end at multiples of their size, whatever the threads; their sums are added in order. Those of the places begin..end-1. */
static int pieces(const struct work *w, const struct loops *loops, size_t begin, size_t end)
{
	const struct pm_cell_list *l = w->list;
	const size_t size = piece_size(l->n);
	int bad = 0;
#pragma omp parallel if (end - begin > size) reduction(| : bad)
	{
		struct pm_neighbour_range *s = pm_alloc(l->most, sizeof *s);
		struct sums own = {.exchange = pm_zalloc(l->n + PM_CELLS_PAD, sizeof(double)), .weight = pm_zalloc(l->n + PM_CELLS_PAD, sizeof(double))};
		bad = !s || !own.exchange || !own.weight;
#pragma omp for ordered schedule(dynamic, 1)
		for (size_t c = begin / size; c < (end + size - 1) / size; c++) {
			if (!bad)
				piece(w, loops, c * size, (c + 1) * size < end ? (c + 1) * size : end, s, &own);
#pragma omp ordered
			if (!bad)
				take(w, &own);
		}
		pm_free(s), pm_free(own.exchange), pm_free(own.weight);
	}
	return bad || (w->kept && w->kept->bad) ? pm_no_memory() : 0;
}

static double *by_place(const struct pm_cell_list *l, const double *values, double times)
{
	double *to = pm_alloc(l->n + PM_CELLS_PAD, sizeof *to);
	for (size_t i = 0; to && i < l->n + PM_CELLS_PAD; i++)
		to[i] = i < l->n ? times * values[l->order[i]] : 0;
	return to;
}

/* The largest weight of the places begin..end-1, and the particles without a partner. */
static void found_at(const struct work *w, size_t begin, size_t end, struct pm_pse_found *found)
{
	for (size_t i = begin; i < end; i++) {
		found->fastest = fmax(found->fastest, w->coefficient[0] * w->volume[i] + w->weight[i]);
		found->alone += w->weight[i] == 0;
	}
}

static int work_init(struct work *w, const struct pm_pse *p, const struct pm_cell_list *l, const double *volume, const double *strength)
{
	const double eps2 = p->eps * p->eps;
	*w = (struct work){.list = l, .volume = by_place(l, volume, 1), .strength = by_place(l, strength, 1),
		.half = p->share ? by_place(l, p->share, 0.5) : NULL, .reach2 = l->reach * l->reach,
		.exponent = -0.25 / eps2, .factor = pow(4 * pm_pi, -0.5 * p->dim) * pow(p->eps, -p->dim) / eps2};
	for (int i = 0; i < PM_PSE_TERMS; i++)
		w->coefficient[i] = p->coefficient[i] / pow(eps2, i);
	w->exchange = pm_zalloc(l->n + 1, sizeof *w->exchange), w->weight = pm_zalloc(l->n + 1, sizeof *w->weight);
	return w->volume && w->strength && w->exchange && w->weight && (w->half || !p->share) ? 0 : pm_failed();
}

static void work_free(struct work *w) { pm_free(w->volume), pm_free(w->strength), pm_free(w->half), pm_free(w->exchange), pm_free(w->weight); }

static const struct loops *loops_of(const struct pm_pse *p) { return &table[p->order / 2 - 1][p->dim - 1][p->share != NULL]; }

/* What shares that differ may add to the largest rate: negative weights count up to twice more. */
static double slack(const struct pm_pse *p, size_t n)
{
	double least = 1;
	for (size_t i = 0; i < n && p->share; i++)
		least = fmin(least, p->share[i]);
	return 2 * (1 - least) * p->negative;
}

/* From the largest sum of weights. */
static void bound(const struct work *w, const struct pm_pse *p, size_t n, struct pm_pse_found *found)
{
	const double integral = 0.5 * p->order;
	found->overlap = found->fastest * w->factor * p->eps * p->eps / integral, found->beyond = p->beyond;
	found->fastest *= w->factor * (1 + p->beyond + slack(p, n));
}

int pm_pse_add(const struct pm_pse *p, const struct pm_cell_list *l, double nu, const double *volume, const double *strength, double *rate,
	struct pm_pse_found *found)
{
	struct work w;
	int status = work_init(&w, p, l, volume, strength);
	status = status ? status : pieces(&w, loops_of(p), 0, l->n);
	*found = (struct pm_pse_found){0};
	for (size_t i = 0; i < l->n && !status; i++)
		rate[l->order[i]] += nu * w.factor * w.exchange[i];
	if (!status)
		found_at(&w, 0, l->n, found);
	bound(&w, p, l->n, found);
	work_free(&w);
	return status;
}

int pm_pse_add_here(int status, const struct pm_pse *p, const struct pm_cell_list *l, double nu, const struct pm_pse_all *all, double *rate,
	struct pm_pse_found *found)
{
	struct pm_pse_kept kept = {.n = 0};
	struct work w = {.kept = NULL};
	size_t begin, end;
	pm_pse_places(l->n, piece_size(l->n), pm_world_rank(), &begin, &end);
	status = status ? status : work_init(&w, p, l, all->volume, all->strength);
	w.kept = &kept;
	status = status ? status : pieces(&w, loops_of(p), begin, end);
	status = pm_pse_bring(status, &kept, l->n, piece_size(l->n), w.exchange, w.weight);
	*found = (struct pm_pse_found){0};
	if (!status)
		found_at(&w, begin, end, found);
	status = pm_pse_found_all(status, found);
	status = pm_pse_return(status, l, piece_size(l->n), all->from, w.exchange);
	for (size_t i = 0; i < l->n && !status; i++)
		if (l->order[i] >= all->from[pm_world_rank()] && l->order[i] < all->from[pm_world_rank() + 1])
			rate[l->order[i] - all->from[pm_world_rank()]] += nu * w.factor * w.exchange[i];
	bound(&w, p, l->n, found);
	work_free(&w), pm_free(kept.of);
	return status;
}
