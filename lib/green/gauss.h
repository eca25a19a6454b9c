/* Green's functions of blobs of order m = 2M, whose transform is zeta = exp(-s) sum_{j<M} s^j/j!, s = sigma^2 k^2/2: all moments below m vanish, so
 * a smooth source is smoothed by O(sigma^m) only, and the function is smooth at 0. With rho = r/sigma, g = exp(-rho^2/2)/(2 pi sigma^2)^(d/2), G2
 * the Green's function of g (the mollifier `gaussian` with delta = sqrt(2) sigma), and Laguerre's polynomials,
 *   G = G2 - (sigma^2/2) g sum_{j<M-1} L_j^(d/2-1)(rho^2/2)/(j+1).
 * If other axes are not open, k^2 in zeta includes their wave numbers; then, and if screened, the product of zeta and the transform of the truncated
 * function is used.
 * Source: Hejlesen, Rasmussen, Chatelain and Walther 2013 (the same polynomials by recursion); Hejlesen, Winckelmans and Walther 2019.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_GREEN_GAUSS_H
#define PM_GREEN_GAUSS_H

#include "green/truncated.h"
#include "mollifier/mollifier.h"

extern const struct pm_mollifier mollifier_gaussian;

static inline double pm_gauss_at(const struct pm_green_case *c, int order, double r2)
{
	double s2 = c->width * c->width, x = 0.5 * r2 / s2, alpha = 0.5 * c->dim - 1, sum = 0, before = 0, now = 1;
	double plain = mollifier_gaussian.potential(r2, sqrt(2) * c->width, c->dim);
	if (x > 60) /* exp(-60) = 9e-27 */
		return plain;
	for (int j = 0; j < order / 2 - 1; j++) {
		sum += now / (j + 1);
		double next = ((2 * j + 1 + alpha - x) * now - (j + alpha) * before) / (j + 1);
		before = now, now = next;
	}
	return plain - 0.5 * s2 * exp(-x) * pow(2 * pm_pi * s2, -0.5 * c->dim) * sum;
}

static inline double pm_gauss_transform(const struct pm_green_case *c, int order, double k2)
{
	double s = 0.5 * c->width * c->width * (k2 + c->k2), sum = 0, term = 1;
	for (int j = 0; j < order / 2; j++) {
		sum += term;
		term *= s / (j + 1);
	}
	return pm_truncated(c, k2) * exp(-s) * sum;
}

/* The entry of order m. */
#define PM_GREEN_GAUSS(m, text) \
	static double at(const struct pm_green_case *c, double r2) { return pm_gauss_at(c, m, r2); } \
	static double transform(const struct pm_green_case *c, double k2) { return pm_gauss_transform(c, m, k2); } \
	const struct pm_green green_gauss##m = {.name = "gauss" #m, .sentence = text, .source = "Hejlesen, Rasmussen, Chatelain and Walther 2013", .order = m, \
		.plain = 1u << 1 | 1u << 2 | 1u << 3, .screened = 1u << 1 | 1u << 2 | 1u << 3, .regular = true, .at = at, .transform = transform, \
		.prepare = pm_truncated_prepare};

#endif
