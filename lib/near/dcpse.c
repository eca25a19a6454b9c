/* Discretisation-corrected PSE: D f(x_p) = eps^-m sum_q (f_q - f_p) eta_p(z_q), z_q = (x_p - x_q)/eps, eta_p = polynomial times exp(-z^2), with the
 * polynomial of each particle such that the moments over its own partners are exact to degree order + m - 1: (-1)^m a! for z^a of a derivative
 * D = d^a of degree m = |a|, 0 for all others; of the Laplacian (m = 2) 2 for every z_i^2. Partners may be those on one side alone.
 * Source: Schrader, Reboux, Sbalzarini 2010, J. Comput. Phys. 229, 4159. Error O(eps^order) for any points that determine the moments, at boundaries too. Not
 * conserving, no volumes. The smallest weights in the window's norm, by Householder's QR with pivots (Golub and Van Loan 2013, 5.4) of the window times
 * the monomials, not of its square. Points that do not determine them (on a line, too few) are found by the rank and refused.
 * Cost: partners times moments squared for each particle: 2 (30 partners, 9 moments) to 300 (290, 55) thousand operations, 8 million for order 6 in 3-D.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "base/simd.h"
#include "near/dcpse.h"

/* Pivots relative to the first: below poor_pivot more partners are used, below least_pivot the matrix is numerically rank-deficient. */
static const double poor_pivot = 1e-2, least_pivot = 1e-9;
static const double wider = 1.19; /* four steps to twice the reach */

double pm_dc_cutoff(int order) { return 2.1 + order / 2; }

/* Exponents of the monomials, and the moments wanted. */
struct moments {
	int n, power[PM_DC_MOMENTS][3];
	double wanted[PM_DC_MOMENTS];
};

static struct moments moments_of(const struct pm_dc *o)
{
	const int *want = o->power, degree = want[0] + want[1] + want[2], most = o->order + (degree ? degree : 2) - 1;
	struct moments m = {.n = 0};
	for (int i = 0; i <= most; i++)
		for (int j = 0; j <= (o->dim > 1 ? most - i : 0); j++)
			for (int k = 0; k <= (o->dim > 2 ? most - i - j : 0); k++) {
				const bool square = i + j + k == 2 && (i == 2 || j == 2 || k == 2), this = i == want[0] && j == want[1] && k == want[2];
				if (i + j + k == 0)
					continue;
				m.power[m.n][0] = i, m.power[m.n][1] = j, m.power[m.n][2] = k;
				m.wanted[m.n++] = degree ? (this ? (degree % 2 ? -1 : 1) * tgamma(i + 1) * tgamma(j + 1) * tgamma(k + 1) : 0) : square ? 2 : 0;
			}
	return m;
}

/* The partners of one particle; b: column by column, then the reflections. */
struct partners {
	size_t n, room;
	size_t *who; /* particles */
	double *sign, *z[3], *window, *b, *eta;
};

static bool partners_room(struct partners *s, size_t n, int columns)
{
	if (n <= s->room)
		return true;
	s->room = n + n / 2;
	double **arrays[] = {&s->sign, &s->z[0], &s->z[1], &s->z[2], &s->window, &s->eta};
	for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
		pm_free(*arrays[i]);
		*arrays[i] = pm_alloc(s->room, sizeof(double));
	}
	pm_free(s->who), pm_free(s->b);
	s->who = pm_alloc(s->room, sizeof *s->who), s->b = pm_alloc(s->room * (size_t)columns, sizeof *s->b);
	return s->sign && s->z[0] && s->z[1] && s->z[2] && s->window && s->eta && s->who && s->b;
}

static void partners_free(struct partners *s)
{
	pm_free(s->who), pm_free(s->sign), pm_free(s->window), pm_free(s->b), pm_free(s->eta);
	for (int d = 0; d < 3; d++)
		pm_free(s->z[d]);
}

static void partners_of(const struct pm_dc *o, const struct pm_cell_list *l, double reach, size_t i, size_t ranges, const struct pm_neighbour_range *s,
	struct partners *p)
{
	const double width = o->eps * reach / o->reach; /* of the window: it widens with the reach, or partners added would have no weight */
	p->n = 0;
	for (size_t k = 0; k < ranges; k++)
		for (size_t j = s[k].from; j < s[k].to; j++) {
			double r2 = 0;
			for (int d = 0; d < o->dim; d++) {
				double r = s[k].side[d] * l->x[d][i] - l->x[d][j] + s[k].shift[d];
				p->z[d][p->n] = s[k].side[d] * r / o->eps; /* x_p less the partner's image */
				r2 += r * r;
			}
			if (r2 > reach * reach || (s[k].kind == PM_HERE && j == i) || (o->side && o->side * p->z[o->axis][p->n] > 1e-9))
				continue; /* z is the particle less its partner */
			p->who[p->n] = l->order[j], p->sign[p->n] = s[k].sign;
			p->window[p->n++] = exp(-0.5 * r2 / (width * width)); /* its square is the window of the kernel */
		}
}

static void fill(const struct moments *m, int dim, struct partners *p)
{
	for (int c = 0; c < m->n; c++) {
		double *b = p->b + (size_t)c * p->n;
		memcpy(b, p->window, p->n * sizeof *b);
		for (int d = 0; d < dim; d++)
			for (int e = 0; e < m->power[c][d]; e++)
				for (size_t q = 0; q < p->n; q++)
					b[q] *= p->z[d][q];
	}
}

static double dot(size_t n, const double *a, const double *b)
{
	pm_simd one = {0}, two = {0};
	size_t i = 0;
	for (; i + 2 * PM_SIMD_WIDTH <= n; i += 2 * PM_SIMD_WIDTH) {
		one = pm_simd_fma(pm_simd_load_any(a + i), pm_simd_load_any(b + i), one);
		two = pm_simd_fma(pm_simd_load_any(a + i + PM_SIMD_WIDTH), pm_simd_load_any(b + i + PM_SIMD_WIDTH), two);
	}
	double sum = pm_simd_sum(one + two);
	for (; i < n; i++)
		sum += a[i] * b[i];
	return sum;
}

static void swap_columns(size_t n, double *a, double *b)
{
	for (size_t i = 0; a != b && i < n; i++) {
		double t = a[i];
		a[i] = b[i], b[i] = t;
	}
}

/* b = QR with the largest column first; column c holds its reflection from row c on, R above; its diagonal and 2/v.v apart. The rank. */
static int decompose(size_t n, int columns, double *b, int *which, double *diagonal, double *scale)
{
	for (int c = 0; c < columns; c++)
		which[c] = c;
	for (int c = 0; c < columns; c++) {
		double *v = b + (size_t)c * n, most = -1, norm2;
		size_t k = (size_t)c, best = k;
		for (size_t j = k; j < (size_t)columns && k < n; j++)
			if ((norm2 = dot(n - k, b + j * n + k, b + j * n + k)) > most)
				most = norm2, best = j;
		if (k >= n || !(sqrt(most) > least_pivot * (c ? fabs(diagonal[0]) : 0)))
			return c;
		swap_columns(n, v, b + best * n);
		int t = which[c];
		which[c] = which[best], which[best] = t;
		diagonal[c] = v[k] > 0 ? -sqrt(most) : sqrt(most);
		scale[c] = 1 / (most - v[k] * diagonal[c]);
		v[k] -= diagonal[c];
		for (size_t j = k + 1; j < (size_t)columns; j++) {
			double *restrict y = b + j * n, f = scale[c] * dot(n - k, v + k, y + k);
			for (size_t i = k; i < n; i++)
				y[i] -= f * v[i];
		}
	}
	return columns;
}

/* eta = window Q R^-T wanted. */
static void solve(const struct moments *m, struct partners *p, const int *which, const double *diagonal, const double *scale)
{
	size_t n = p->n;
	memset(p->eta, 0, n * sizeof *p->eta);
	for (int c = 0; c < m->n; c++)
		p->eta[c] = (m->wanted[which[c]] - dot((size_t)c, p->b + (size_t)c * n, p->eta)) / diagonal[c];
	for (int c = m->n - 1; c >= 0; c--) {
		const double *v = p->b + (size_t)c * n;
		double f = scale[c] * dot(n - (size_t)c, v + c, p->eta + c);
		for (size_t i = (size_t)c; i < n; i++)
			p->eta[i] -= f * v[i];
	}
	for (size_t q = 0; q < n; q++)
		p->eta[q] *= p->window[q];
}

/* What is shared by all particles. */
struct work {
	const struct pm_dc *o;
	const struct pm_cell_list *l;
	struct moments m;
	double factor;
	int fields;
	const double *const *value;
	double *const *rate;
};

/* The particle at place i; the row sum. */
static double particle(const struct work *w, size_t i, size_t ranges, const struct pm_neighbour_range *s, struct partners *p, int *rank, bool *widened)
{
	int which[PM_DC_MOMENTS];
	double diagonal[PM_DC_MOMENTS], scale[PM_DC_MOMENTS], sum = 0, size = 0;
	size_t me = w->l->order[i];
	for (double reach = w->o->reach;; reach = fmin(reach * wider, w->l->reach)) {
		partners_of(w->o, w->l, reach, i, ranges, s, p);
		fill(&w->m, w->o->dim, p);
		*rank = decompose(p->n, w->m.n, p->b, which, diagonal, scale);
		if (reach >= w->l->reach || (*rank == w->m.n && fabs(diagonal[*rank - 1]) > poor_pivot * fabs(diagonal[0])))
			break;
		*widened = true;
	}
	if (*rank < w->m.n)
		return 0;
	solve(&w->m, p, which, diagonal, scale);
	for (size_t q = 0; q < p->n; q++)
		sum += p->eta[q], size += fabs(p->eta[q]);
	for (int f = 0; f < w->fields; f++) {
		double derivative = 0;
		for (size_t q = 0; q < p->n; q++)
			derivative += (p->sign[q] * w->value[f][p->who[q]] - w->value[f][me]) * p->eta[q];
		w->rate[f][me - (w->o->here ? w->o->here[0] : 0)] += w->factor * derivative;
	}
	return fabs(sum) + size;
}

/* One cell; in *found the largest row sum, and of those stuck the first in the stream. */
static bool cell(const struct work *w, size_t c, struct pm_neighbour_range *s, struct partners *p, struct pm_dc_found *found)
{
	size_t n = pm_cell_list_around(w->l, c, false, s), room = 0;
	const uint64_t *here = w->o->here;
	for (size_t k = 0; k < n; k++)
		room += s[k].to - s[k].from;
	if (!partners_room(p, room, w->m.n))
		return false;
	for (size_t i = w->l->start[c]; i < w->l->start[c + 1]; i++) {
		int rank;
		bool widened = false;
		if (here && (w->l->order[i] < here[0] || w->l->order[i] >= here[1]))
			continue;
		found->fastest = fmax(found->fastest, particle(w, i, n, s, p, &rank, &widened));
		found->widened += widened;
		if (rank < w->m.n && w->l->order[i] < found->stuck)
			*found = (struct pm_dc_found){found->fastest, found->widened, w->l->order[i], p->n, rank, w->m.n};
	}
	return true;
}

int pm_dc_add(const struct pm_dc *o, const struct pm_cell_list *l, double nu, int fields, const double *const value[], double *const rate[],
	struct pm_dc_found *found)
{
	const int degree = o->power[0] + o->power[1] + o->power[2];
	const double scale = pow(o->eps, degree ? degree : 2);
	struct work w = {.o = o, .l = l, .m = moments_of(o), .factor = nu / scale, .fields = fields, .value = value, .rate = rate};
	bool bad = false;
	*found = (struct pm_dc_found){.stuck = SIZE_MAX};
#pragma omp parallel if (l->n > 64)
	{
		struct pm_neighbour_range *s = pm_alloc(l->most, sizeof *s);
		struct partners p = {.n = 0};
		struct pm_dc_found own = {.stuck = SIZE_MAX};
		bool good = s != NULL;
#pragma omp for schedule(dynamic, 4)
		for (size_t c = 0; c < l->occupied; c++)
			good = good && cell(&w, c, s, &p, &own);
#pragma omp critical
		{
			double fastest = fmax(found->fastest, own.fastest);
			uint64_t widened = found->widened + own.widened;
			if (own.stuck < found->stuck)
				*found = own;
			found->fastest = fastest, found->widened = widened;
			bad |= !good;
		}
		partners_free(&p);
		pm_free(s);
	}
	found->fastest /= scale;
	return bad ? -PM_DATA : found->stuck < SIZE_MAX ? -PM_NUMERICS : 0;
}
