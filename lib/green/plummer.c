/* Plummer's softening: the Green's function of lap G - kappa^2 G = delta function at s = sqrt(r^2 + epsilon^2) in place of r: 3-D -exp(-kappa s)/(4 pi s),
 * 2-D -K0(kappa s)/(2 pi), 1-D -exp(-kappa s)/(2 kappa), for kappa = 0 the potentials of pp --mollifier plummer. Its transform is -x K1(x)/q^2 with
 * q^2 = k^2 + kappa^2 and x = q epsilon in every dimension: integrated along an axis the 3-D function is the 2-D one, and that the 1-D one. So the factor
 * x K1(x) serves faces that are not open as well. As in hockney.c the value at 0 makes the sum over nodes equal to the integral for a constant source.
 * By heat kernels, with the cell V, it is the value of hockney and
 *   (1/V) int_0^inf exp(-kappa^2 t) (1 - exp(-epsilon^2/4t)) (V (4 pi t)^(-d/2) + 1 - prod theta) dt, theta = 1 + 2 sum_n exp(-(2 pi n/h)^2 t),
 * which is 0 for epsilon = 0; for epsilon = 2 h their sum is -1/(4 pi epsilon) to 6e-5. Order 4 in h for smooth sources, and beyond every power once
 * the mesh resolves epsilon. Source: Plummer 1911; Gradshteyn and Ryzhik 6.532 for the transform. Cost: an exponential per node, 300 terms for each kappa.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "green-parts/free-space.h"

extern const struct pm_green green_hockney;

/* theta, of the two sums the one with the fewer terms: h (4 pi t)^(-1/2) (1 + 2 sum_n exp(-n^2 h^2/4t)) where t is small. */
static double theta(double h, double t)
{
	const double a = pow(2 * pm_pi / h, 2) * t, b = 0.25 * h * h / t, larger = fmax(a, b); /* at least pi: exp(-16 pi) = 1e-22 */
	const double sum = 1 + 2 * (exp(-larger) + exp(-4 * larger) + exp(-9 * larger));
	return a > b ? sum : sum * h / sqrt(4 * pm_pi * t);
}

/* V (4 pi t)^(-d/2) + 1 - prod theta; 1 where the first and the last differ by less than round-off. */
static double bracket(const struct pm_green_case *c, double t)
{
	double cell = 1, all = 1, least = HUGE_VAL;
	for (int d = 0; d < c->dim; d++) {
		cell *= c->h[d] / sqrt(4 * pm_pi * t);
		all *= theta(c->h[d], t);
		least = fmin(least, 0.25 * c->h[d] * c->h[d] / t);
	}
	return least > 45 ? 1 : cell + 1 - all;
}

/* By the trapezoidal rule in ln t: analytic within pi/2 of the real line, so the error of step 1/4 is exp(-39). The ends: 1e-17 of the integral. */
static double more(const struct pm_green_case *c)
{
	const double e2 = 0.25 * c->width * c->width, step = 0.25;
	double cell = 1, middle = e2, sum = 0;
	for (int d = 0; d < c->dim; d++) {
		cell *= c->h[d];
		middle = fmax(middle, c->h[d] * c->h[d]);
	}
	for (double p = log(middle) - 40; p < log(middle) + 80.0 / c->dim; p += step) {
		const double t = exp(p);
		sum += t * exp(-c->kappa * c->kappa * t) * -expm1(-e2 / t) * bracket(c, t);
	}
	return step * sum / cell;
}

static void prepare(struct pm_green_case *c)
{
	green_hockney.prepare(c);
	if (c->width > 0)
		c->constant[0] += more(c);
}

static double at(const struct pm_green_case *c, double r2) { return r2 > 0 ? pm_green_free(c->dim, c->kappa, r2 + c->width * c->width) : c->constant[0]; }

static double factor(double x)
{
	if (x < 1e-9) /* 1 + x^2 ln(x)/2 */
		return 1;
	return x > 700 ? 0 : x * exp(-x) * gsl_sf_bessel_K1_scaled(x);
}

const struct pm_green green_plummer = {
	.name = "plummer",
	.sentence = "softened, at sqrt(r^2 + softening^2) in place of r, whatever the faces",
	.source = "Plummer 1911",
	.order = 4,
	.plain = 1u << 1 | 1u << 2 | 1u << 3,
	.screened = 1u << 1 | 1u << 2 | 1u << 3,
	.regular = true,
	.at = at,
	.factor = factor,
	.prepare = prepare,
};
