/* Green's functions of blobs of order m = 2M, whose transform is zeta = exp(-s) sum_{j<M} s^j/j!, s = sigma^2 k^2/2: all moments below m vanish, so
 * a smooth source is smoothed by O(sigma^m) only, and the function is smooth at 0. With rho = r/sigma, g = exp(-rho^2/2)/(2 pi sigma^2)^(d/2), G2
 * the Green's function of g (the mollifier `gaussian` with delta = sqrt(2) sigma), and Laguerre's polynomials,
 *   G = G2 - (sigma^2/2) g sum_{j<M-1} L_j^(d/2-1)(rho^2/2)/(j+1).
 * If other axes are not open, k^2 in zeta includes their wave numbers k2. Then, and if screened (K), with a = sigma^2/2, y = a k2, w = a K^2, x = rho^2/2,
 * E_n(y) = sum_{i<=n} y^i/i!, and 1/(k^2 + kappa^2) as an integral of heat kernels, whose time is a (v - 1),
 *   G = -a int_1^inf exp(-y v - w (v - 1)) (2 pi sigma^2 v)^(-d/2) exp(-x/v) sum_{l<M} E_{M-1-l}(y) v^-l L_l^(d/2-1)(x/v) dv,
 * and beyond the blob zeta at s = -w times the function of a point. For blobs much wider than a cell the product of zeta and the transform of the
 * truncated function is used instead. zeta must then be 0 to round-off at the Nyquist wave: where it is not, the cut spectrum rings, by an amount that
 * depends on the cut-off, hence on the size of the box (in 2 of 3 axes: 1e-7 of phi at sigma = 2 h for order 10, 1e-3 at sigma = 0.7 h).
 * Source: Hejlesen, Rasmussen, Chatelain and Walther 2013 (the same polynomials by recursion); Hejlesen, Winckelmans and Walther 2019.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "green-parts/gauss-blob.h"
#include "green-parts/free-space.h"
#include "green-parts/truncated.h"
#include "mollifier/mollifier.h"

extern const struct pm_mollifier mollifier_gaussian;

/* exp(w) times 1 + (-w) + ... + (-w)^(M-1)/(M-1)!, times the function of a point. */
static double far(const struct pm_green_case *c, int order, double w, double r2)
{
	double sum = 0, term = 1;
	if (c->kappa * sqrt(r2) > 300) /* and w is less than half of that */
		return 0;
	for (int j = 0; j < order / 2; j++) {
		sum += term;
		term *= -w / (j + 1);
	}
	return exp(w) * sum * pm_green_free(c->dim, c->kappa, r2);
}

/* sum_{l<M} E_{M-1-l}(y) v^-l L_l^(alpha)(z) */
static double shape(int order, const double *partial, double alpha, double v, double z)
{
	double sum = 0, before = 0, now = 1, power = 1;
	for (int l = 0; l < order / 2; l++) {
		sum += partial[order / 2 - 1 - l] * power * now;
		double next = ((2 * l + 1 + alpha - z) * now - (l + alpha) * before) / (l + 1);
		before = now, now = next, power /= v;
	}
	return sum;
}

/* The integral, by the trapezoidal rule in p, v = 1 + exp(p - exp(-p))/(1 + y + w), whose ends decay doubly exponentially (Takahasi and Mori 1974).
 * Against the Fourier integral (tests/unit/green-gauss.c) 1e-13 of G(0), the error of that reference. */
static double wave(const struct pm_green_case *c, int order, double r2)
{
	const double a = 0.5 * c->width * c->width, y = a * c->k2, all = a * c->kappa * c->kappa, w = fmax(all - y, 0), x = 0.25 * r2 / a;
	const double alpha = 0.5 * c->dim - 1, step = 0.1 /* 0.15: 1e-13 */, edge = c->kappa * c->width * c->width + 9 * c->width;
	double partial[8], sum = 0, term = 1, tau = 0;
	if (r2 > edge * edge)
		return far(c, order, w, r2);
	for (int j = 0; j < order / 2; j++) {
		partial[j] = term + (j ? partial[j - 1] : 0);
		term *= y / (j + 1);
	}
	for (double p = -3.75; all * tau < 45; p += step) {
		double e = exp(-p), v = 1 + (tau = exp(p - e) / (1 + all)), z = x / v;
		sum += tau * (1 + e) * exp(-y - all * tau - z) * pow(v, -alpha - 1) * shape(order, partial, alpha, v, z);
	}
	return -a * step * pow(4 * pm_pi * a, -alpha - 1) * sum;
}

double pm_gauss_at(const struct pm_green_case *c, int order, double r2)
{
	if (c->kappa > 0)
		return wave(c, order, r2);
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

double pm_gauss_transform(const struct pm_green_case *c, int order, double k2)
{
	double s = 0.5 * c->width * c->width * (k2 + c->k2), sum = 0, term = 1;
	for (int j = 0; j < order / 2; j++) {
		sum += term;
		term *= s / (j + 1);
	}
	return pm_truncated(c, k2) * exp(-s) * sum;
}

bool pm_gauss_smooth(const struct pm_green_case *c)
{
	double h = 0;
	for (int d = 0; d < c->dim; d++)
		h = fmax(h, c->h[d]);
	return c->width >= 3 * h;
}
