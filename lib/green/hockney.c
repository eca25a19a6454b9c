/* The free-space Green's function sampled at the nodes, with the value at r = 0 that makes the sum over nodes equal to the integral for a
 * constant source: sum_j h^d G(x-x_j) s_j then differs from the integral by O(h^4) for smooth sources. By Ewald's splitting, exact for any ratio of spacings
 * (V, A, h the cell, q its reciprocal lattice, t = 1/4a^2); G(0) is, for kappa > 0 and in the limit 0,
 *   3-D Z/4 pi: Z = sum' near3 + (4 pi/V)(sum' exp(-(q^2+kappa^2)t)/(q^2+kappa^2) + (exp(-kappa^2 t)-1)/kappa^2) - far part at 0; cube -2.83729748/h
 *   2-D Z/2 pi likewise, of K0(kappa r) or -ln r: near2 = sum_j (-kappa^2 t)^j/j! E_{j+1}(a^2 r^2)/2;   square, kappa = 0: ln h - 1.3105329259
 *   1-D: coth(kappa h/2)/(2 kappa) - 1/(kappa^2 h) - 1/(2 kappa), h/12 for kappa = 0 (Euler and Maclaurin).
 * Source: Hockney and Eastwood 1988, 6-5-4, with the corrected trapezoidal rule of Marin, Runborg and Tornberg 2014, constants as in Duan and Rokhlin
 * 2009; Ewald 1921. Cost: some thousand terms for each kappa.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_sf_expint.h>

#include "green-parts/free-space.h"

struct ewald {
	int dim;
	double a, kappa;
};

/* Sum over a lattice without its origin, until a term is below 1e-17 of the sum. */
static double lattice(const struct ewald *e, const double step[3], double reach, double (*term)(const struct ewald *e, double r2))
{
	long most[3] = {0, 0, 0};
	for (int d = 0; d < e->dim; d++)
		most[d] = (long)ceil(reach / step[d]);
	struct pm_sum sum = {0, 0};
	for (long k = -most[2]; k <= most[2]; k++)
		for (long j = -most[1]; j <= most[1]; j++)
			for (long i = -most[0]; i <= most[0]; i++) {
				double x = (double)i * step[0], y = (double)j * step[1], z = (double)k * step[2];
				double r2 = x * x + y * y + z * z;
				if (r2 > 0 && r2 <= reach * reach)
					pm_sum_add(&sum, term(e, r2));
			}
	return pm_sum_total(sum);
}

static double near3(const struct ewald *e, double r2)
{
	double r = sqrt(r2), b = e->kappa / (2 * e->a);
	return (exp(e->kappa * r) * erfc(e->a * r + b) + exp(-e->kappa * r) * erfc(e->a * r - b)) / (2 * r);
}

static double near2(const struct ewald *e, double r2)
{
	double b2 = pow(e->kappa / (2 * e->a), 2), sum = 0, power = 0.5; /* b2 <= 1: 20 terms */
	for (int j = 0; j < 20 && power != 0; j++) {
		sum += power * gsl_sf_expint_En(j + 1, e->a * e->a * r2);
		power *= -b2 / (j + 1);
	}
	return sum;
}

static double far(const struct ewald *e, double q2)
{
	double k2 = q2 + e->kappa * e->kappa;
	return exp(-k2 / (4 * e->a * e->a)) / k2;
}

/* The value of the far part at r = 0, minus (for kappa = 0) the constant by which K0 exceeds -ln r. */
static double self(const struct ewald *e)
{
	const double gamma = 0.57721566490153286;
	double b = e->kappa / (2 * e->a);
	if (e->dim == 3)
		return 2 * e->a / sqrt(pm_pi) * exp(-b * b) - e->kappa * erfc(b);
	return b > 0 ? 0.5 * gsl_sf_expint_E1(b * b) : 0.5 * gamma + log(e->a);
}

static double centre(const struct pm_green_case *c)
{
	double x = c->kappa * c->h[0], q[3] = {0, 0, 0}, cell = 1;
	if (c->dim == 1) {
		if (x < 1e-2) /* by the series: the divergent terms cancel */
			return (c->kappa > 0 ? -0.5 / c->kappa : 0) + c->h[0] * (1.0 / 12 - x * x / 720 + x * x * x * x / 30240);
		return 0.5 / (c->kappa * tanh(0.5 * x)) - 1 / (x * c->kappa) - 0.5 / c->kappa;
	}
	for (int d = 0; d < c->dim; d++) {
		q[d] = 2 * pm_pi / c->h[d];
		cell *= c->h[d];
	}
	struct ewald e = {c->dim, sqrt(pm_pi) / pow(cell, 1.0 / c->dim), c->kappa};
	e.a = fmax(e.a, 0.5 * c->kappa);
	double circle = 2 * pm_pi * (c->dim - 1), t = 1 / (4 * e.a * e.a), k2 = c->kappa * c->kappa;
	/* erfc(6.2) and exp(-6.2^2) are below 2e-17. */
	double z = lattice(&e, c->h, 6.2 / e.a, c->dim == 3 ? near3 : near2) + circle / cell * lattice(&e, q, 12.4 * e.a, far);
	return (z + circle / cell * (k2 > 0 ? expm1(-k2 * t) / k2 : -t) - self(&e)) / circle;
}

static void prepare(struct pm_green_case *c)
{
	c->constant[0] = centre(c);
}

static double at(const struct pm_green_case *c, double r2)
{
	return r2 > 0 ? pm_green_free(c->dim, c->kappa, r2) : c->constant[0];
}

const struct pm_green green_hockney = {
	.name = "hockney",
	.sentence = "sampled at the nodes, its value at 0 corrected",
	.source = "Hockney and Eastwood 1988; Marin, Runborg and Tornberg 2014",
	.order = 4,
	.plain = 1u << 1 | 1u << 2 | 1u << 3,
	.screened = 1u << 1 | 1u << 2 | 1u << 3,
	.at = at,
	.prepare = prepare,
};
