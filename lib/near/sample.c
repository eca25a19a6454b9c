/* Smoothed particle approximation u_eps(x) = sum_p G_p zeta_eps(x - x_p), zeta_eps(x) = eps^-d zeta(|x|/eps), with s = (r/eps)^2:
 *   Gaussian order 2: (2 pi)^(-d/2) exp(-s/2); order 4: times (d + 2 - s)/2, whose second moment is 0
 *   algebraic order 4: Gamma(d/2 + 2)/pi^(d/2) (d/2 + 1 - s)/(1 + s)^(d/2 + 3); in 2-D 2 (2 - s)/(pi (1 + s)^4). Its fourth moment diverges as a logarithm.
 * Derivatives are those of zeta. Source: Hald 1979; Beale and Majda 1985; Cottet and Koumoutsakos 2000, section 2.3. Error O(eps^order) and the
 * quadrature's, which is beyond every power of h/eps for a lattice and smooth u. Images: periodic, odd at walls, even at neumann faces; nothing beyond open
 * ones. Cost: targets times particles within the reach, eight at a time. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "near/sample.h"
#include "base/simd.h"

const char *const pm_sample_kind_names[] = {"gaussian", "algebraic", NULL}, *const pm_sample_operator_names[] = {"value", "grad", "lap", NULL};

/* Beyond, less than 1e-14 of the largest value (Gaussian); 3e-7 of the integral (algebraic, which falls as r^(-dim - 4)). */
double pm_sample_cutoff(enum pm_sample_kind kind, int order) { return kind == PM_SAMPLE_ALGEBRAIC ? 40 : order == 4 ? 9 : 8.5; }

double pm_sample_overlap(enum pm_sample_kind kind) { return kind == PM_SAMPLE_ALGEBRAIC ? 3 : 1.5; }

int pm_sample_components(const struct pm_sample *o)
{
	switch (o->operator) {
	case PM_SAMPLE_GRAD: return o->dim;
	case PM_SAMPLE_FIRST: return 1 + o->dim;
	case PM_SAMPLE_SECOND: return (o->dim + 1) * (o->dim + 2) / 2;
	default: return 1;
	}
}

static double scale(const struct pm_sample *o)
{
	const double x = 0.5 * o->dim;
	return pow(o->eps, -o->dim) * (o->kind == PM_SAMPLE_GAUSSIAN ? pow(2 * pm_pi, -x) : tgamma(x + 2) * pow(pm_pi, -x));
}

/* Without the scale: 1, or the polynomial of a Gaussian of order 4, or the algebraic. */
void pm_sample_mollifier(const struct pm_sample *o, double s, double w[3])
{
	if (o->kind == PM_SAMPLE_GAUSSIAN) {
		double e = scale(o) * exp(-0.5 * s), p = o->order == 4 ? 0.5 * (o->dim + 2 - s) : 1, slope = o->order == 4 ? -0.5 : 0;
		w[0] = p * e;
		w[1] = (slope - 0.5 * p) * e;
		w[2] = (0.25 * p - slope) * e;
		return;
	}
	double p = 0.5 * o->dim + 3, a = 0.5 * o->dim + 1 - s, q = 1 / (1 + s), e = scale(o) * pow(q, p);
	w[0] = a * e;
	w[1] = -e * (1 + p * a * q);
	w[2] = e * q * p * (2 + (p + 1) * a * q);
}

/* w by lanes, without the scale; only what the operator needs. */
PM_SIMD_INLINE void lanes(const struct pm_sample *o, pm_simd s, pm_simd w[3])
{
	if (o->kind == PM_SAMPLE_GAUSSIAN) {
		pm_simd e = pm_simd_exp(s * pm_simd_all(-0.5));
		pm_simd p = o->order == 4 ? pm_simd_all(0.5 * (o->dim + 2)) - s * pm_simd_all(0.5) : pm_simd_all(1);
		const double slope = o->order == 4 ? -0.5 : 0;
		w[0] = p * e;
		w[1] = (pm_simd_all(slope) - p * pm_simd_all(0.5)) * e;
		w[2] = (p * pm_simd_all(0.25) - pm_simd_all(slope)) * e;
		return;
	}
	const double p = 0.5 * o->dim + 3;
	pm_simd q = pm_simd_all(1) / (pm_simd_all(1) + s), a = pm_simd_all(0.5 * o->dim + 1) - s, q2 = q * q, e = q2 * q, root = q;
	for (int i = 0; i < PM_SIMD_WIDTH && o->dim != 2; i++)
		root[i] = sqrt(q[i]);
	e *= o->dim == 1 ? root : o->dim == 2 ? q : q * root;
	w[0] = a * e;
	w[1] = -e * (pm_simd_all(1) + pm_simd_all(p) * a * q);
	w[2] = e * q * pm_simd_all(p) * (pm_simd_all(2) + pm_simd_all(p + 1) * a * q);
}

static double sign_of(const struct pm_sample *o, const struct pm_neighbour_range *r) { return o->even ? fabs((double)r->sign) : (double)r->sign; }

/* The sums of one target at x over a range. */
PM_SIMD_INLINE void range_sum(const struct pm_sample *o, const struct pm_cell_list *l, const double *q, const struct pm_neighbour_range *r, const double x[3],
	double sum[])
{
	const double over = 1 / (o->eps * o->eps), reach = o->reach * o->reach * over;
	pm_simd total[3] = {{0}};
	for (size_t j = r->from; j < r->to; j += PM_SIMD_WIDTH) {
		pm_simd s = {0}, apart[3], w[3], g = pm_simd_load_any(q + j);
		for (int d = 0; d < o->dim; d++) {
			apart[d] = pm_simd_all(r->side[d] * x[d] + r->shift[d]) - pm_simd_load_any(l->x[d] + j);
			s = pm_simd_fma(apart[d], apart[d], s);
		}
		s *= pm_simd_all(over);
		if (r->to - j < PM_SIMD_WIDTH)
			s = pm_simd_between(0, r->to - j, s, pm_simd_all(HUGE_VAL));
		g = pm_simd_where_not_below(pm_simd_all(reach), s, g);
		s = pm_simd_where_not_below(pm_simd_all(reach), s, s); /* 0 beyond, where the strength is 0 too */
		lanes(o, s, w);
		if (o->operator == PM_SAMPLE_VALUE)
			total[0] = pm_simd_fma(g, w[0], total[0]);
		else if (o->operator == PM_SAMPLE_LAP)
			total[0] = pm_simd_fma(g, pm_simd_all(4) * s * w[2] + pm_simd_all(2 * o->dim) * w[1], total[0]);
		else
			for (int d = 0; d < o->dim; d++)
				total[d] = pm_simd_fma(g * w[1], apart[d], total[d]);
	}
	for (int d = 0; d < 3; d++)
		sum[d] += sign_of(o, r) * (o->operator == PM_SAMPLE_GRAD ? r->side[d] : 1) * pm_simd_sum(total[d]);
}

/* The moments in the same way. Mirrored, a target sees the particles, so that its own distance has the sign of the side. */
static void range_moments(const struct pm_sample *o, const struct pm_cell_list *l, const double *q, const struct pm_neighbour_range *r, const double x[3],
	double sum[])
{
	const double over = 1 / o->eps, reach = o->reach * o->reach * over * over;
	pm_simd total[PM_SAMPLE_SUMS] = {{0}};
	for (size_t j = r->from; j < r->to; j += PM_SIMD_WIDTH) {
		pm_simd s = {0}, z[4], w[3], g = pm_simd_load_any(q + j);
		for (int d = 0; d < o->dim; d++) {
			z[d + 1] = (pm_simd_all(r->side[d] * x[d] + r->shift[d]) - pm_simd_load_any(l->x[d] + j)) * pm_simd_all(r->side[d] * over);
			s = pm_simd_fma(z[d + 1], z[d + 1], s);
		}
		if (r->to - j < PM_SIMD_WIDTH)
			s = pm_simd_between(0, r->to - j, s, pm_simd_all(HUGE_VAL));
		g = pm_simd_where_not_below(pm_simd_all(reach), s, g);
		s = pm_simd_where_not_below(pm_simd_all(reach), s, s);
		lanes(o, s, w);
		z[0] = pm_simd_all(1), w[0] *= g;
		for (int d = 0, at = 0; d <= (o->operator == PM_SAMPLE_SECOND ? o->dim : 0); d++)
			for (int e = d; e <= o->dim; e++, at++)
				total[at] += pm_simd_where_not_below(pm_simd_all(reach), s, w[0] * z[d] * z[e]);
	}
	for (int c = 0; c < pm_sample_components(o); c++)
		sum[c] += sign_of(o, r) * pm_simd_sum(total[c]);
}

/* The sums at a place of the list over n ranges, without the factor. */
static void target(const struct pm_sample *o, const struct pm_cell_list *l, const double *q, size_t place, size_t n, const struct pm_neighbour_range *s,
	double sum[])
{
	const double x[3] = {l->x[0][place], o->dim > 1 ? l->x[1][place] : 0, o->dim > 2 ? l->x[2][place] : 0};
	memset(sum, 0, PM_SAMPLE_SUMS * sizeof *sum);
	for (size_t i = 0; i < n; i++)
		(o->operator >= PM_SAMPLE_FIRST ? range_moments : range_sum)(o, l, q, s + i, x, sum);
}

int pm_sample_sum(const struct pm_sample *o, const struct pm_cell_list *l, const double *strength, size_t first, size_t targets, double *const out[])
{
	const double over = 1 / (o->eps * o->eps);
	const double factor = scale(o) * (o->operator == PM_SAMPLE_GRAD ? 2 * over : o->operator == PM_SAMPLE_LAP ? over : 1);
	double *q = pm_alloc(l->n + PM_CELLS_PAD, sizeof *q);
	int bad = !q;
	for (size_t i = 0; q && i < l->n + PM_CELLS_PAD; i++)
		q[i] = i < l->n ? strength[l->order[i]] : 0;
#pragma omp parallel reduction(| : bad)
	{
		struct pm_neighbour_range *s = pm_alloc(l->most, sizeof *s);
		bad |= !s;
#pragma omp for schedule(dynamic, 16)
		for (size_t c = 0; c < l->occupied; c++) {
			size_t n = 0, place = l->start[c];
			for (; s && q && place < l->start[c + 1]; place++) {
				const size_t k = l->order[place] - first;
				if (k >= targets) /* a source, also below first */
					continue;
				n = n ? n : pm_cell_list_around(l, c, false, s);
				double sum[PM_SAMPLE_SUMS];
				target(o, l, q, place, n, s, sum);
				for (int d = 0; d < pm_sample_components(o); d++)
					out[d][k] = factor * sum[d];
			}
		}
		pm_free(s);
	}
	pm_free(q);
	return bad ? pm_no_memory() : 0;
}
