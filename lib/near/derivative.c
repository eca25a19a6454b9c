/* The general integral operator of particle strength exchange: D^b f(x_p) = sum_q V_q (f_q -/+ f_p) eta(x_p - x_q), eta = D^b W_eps, so that its moments are
 * (-1)^m b! for z^b and 0 for all others to degree m + order - 1, m = |b|. W is the Gaussian g = (4 pi)^(-dim/2) exp(-z^2/4) made of the given order:
 *     W = sum over a+b+c < order/2 of (-1)^(a+b+c)/(a! b! c!) d_x^2a d_y^2b d_z^2c g,   transform exp(-k^2) sum_j k^2j/j!,
 * and d^n exp(-z^2/4) = P_n(z) exp(-z^2/4), P_(n+1) = -(z P_n + n P_(n-1))/2 (Hermite). Source: Eldredge, Leonard and Colonius 2002, J. Comput. Phys. 180,
 * 686. Twice the half of eta on one side has the right first moment and wrong second ones: order 1. Error O(eps^order) + quadrature, which needs
 * eps >= h and points that are nearly a lattice. Cost: N times partners, one at a time, 10 to 60 ns each.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "near/derivative.h"

enum { TERMS = 20, HIGHEST = PM_DERIVATIVE_DEGREE + 6 }; /* a + b + c <= 3 in 3-D; the highest derivative of g along an axis */

/* eta as products of Hermite polynomials along the axes. */
struct kernel {
	int terms, power[TERMS][3], highest;
	double factor[TERMS], scale;
};

static struct kernel kernel_of(const struct pm_derivative *o)
{
	const int most = o->order / 2 - 1;
	struct kernel k = {.scale = pow(4 * pm_pi, -0.5 * o->dim) * pow(o->eps, -o->dim - o->power[0] - o->power[1] - o->power[2])};
	for (int a = 0; a <= most; a++)
		for (int b = 0; b <= (o->dim > 1 ? most - a : 0); b++)
			for (int c = 0; c <= (o->dim > 2 ? most - a - b : 0); c++) {
				const int twice[3] = {2 * a, 2 * b, 2 * c};
				k.factor[k.terms] = ((a + b + c) % 2 ? -1 : 1) / (tgamma(a + 1) * tgamma(b + 1) * tgamma(c + 1));
				for (int d = 0; d < 3; d++) {
					k.power[k.terms][d] = o->power[d] + twice[d];
					k.highest = k.power[k.terms][d] > k.highest ? k.power[k.terms][d] : k.highest;
				}
				k.terms++;
			}
	return k;
}

static double kernel_at(const struct kernel *k, int dim, const double z[3])
{
	double p[3][HIGHEST + 1], z2 = 0, sum = 0;
	for (int d = 0; d < dim; d++) {
		p[d][0] = 1, p[d][1] = -0.5 * z[d], z2 += z[d] * z[d];
		for (int n = 1; n < k->highest; n++)
			p[d][n + 1] = -0.5 * (z[d] * p[d][n] + n * p[d][n - 1]);
	}
	for (int t = 0; t < k->terms; t++) {
		double product = k->factor[t];
		for (int d = 0; d < dim; d++)
			product *= p[d][k->power[t][d]];
		sum += product;
	}
	return k->scale * sum * exp(-0.25 * z2);
}

static double particle(const struct pm_derivative *o, const struct kernel *k, const struct pm_cell_list *l, size_t i, size_t ranges,
	const struct pm_neighbour_range *s, const double *volume, const double *f)
{
	const double own = (o->plus ? -1 : 1) * f[l->order[i]];
	double sum = 0;
	for (size_t r = 0; r < ranges; r++)
		for (size_t j = s[r].from; j < s[r].to; j++) {
			double z[3] = {0}, r2 = 0;
			for (int d = 0; d < o->dim; d++) {
				const double x = s[r].side[d] * l->x[d][i] - l->x[d][j] + s[r].shift[d];
				z[d] = s[r].side[d] * x / o->eps; /* the particle less its partner's image */
				r2 += x * x;
			}
			if (r2 > l->reach * l->reach || (s[r].kind == PM_HERE && j == i && !o->plus) || (o->side && o->side * z[o->axis] > 1e-9))
				continue;
			const size_t q = l->order[j];
			/* those exactly abreast belong half to either side; the derivative of the kernel is 0 there */
			sum += volume[q] * (s[r].sign * f[q] - own) * kernel_at(k, o->dim, z);
		}
	return o->side ? 2 * sum : sum;
}

int pm_derivative_add(const struct pm_derivative *o, const struct pm_cell_list *l, const double *volume, const double *f, double *rate)
{
	const struct kernel k = kernel_of(o);
	const uint64_t all[2] = {0, l->n}, *here = o->here ? o->here : all;
	bool bad = false;
#pragma omp parallel if (l->n > 64) reduction(|| : bad)
	{
		struct pm_neighbour_range *s = pm_alloc(l->most, sizeof *s);
		bad = !s;
#pragma omp for schedule(dynamic, 4)
		for (size_t c = 0; c < l->occupied; c++) {
			const size_t ranges = s ? pm_cell_list_around(l, c, false, s) : 0;
			for (size_t i = l->start[c]; s && i < l->start[c + 1]; i++)
				if (l->order[i] >= here[0] && l->order[i] < here[1])
					rate[l->order[i] - here[0]] += particle(o, &k, l, i, ranges, s, volume, f);
		}
		pm_free(s);
	}
	return bad ? pm_no_memory() : 0;
}
