/* The Green's function of centred differences of order 2, 4, 6 on an infinite lattice, lap_h G - kappa^2 G = delta_i0/V, the time that heat spends
 * at a node: G_i = -int_0^inf exp(-kappa^2 t) K_x(i,t) K_y(j,t) K_z(k,t) dt, K(i,t) = 1/(2 pi h) int exp(-t lambda(theta)/h^2) cos(i theta) dtheta.
 * The integral by Gauss and Legendre's 16 nodes in [0, h^2] and in panels of ratio 4 up to T = 1e9 h^2 (or 50/kappa^2), K by cosine transforms, for s = t/h^2
 * above 1e6 by its expansion g (1 + (2 c4/s) L2(i^2/4s)), lambda = theta^2 - c4 theta^4 + ..., L2(x) = 3/8 - 3x/2 + x^2/2 of Laguerre (alpha = -1/2),
 * g the Gaussian of variance 2t; from T on the continuum's, for kappa = 0 the potential of a Gaussian with delta^2 = 4T, which also fixes the gauge: ln r.
 * Source: the integral of Bessel functions of Katsura et al. 1971, for any stencil; Liska and Colonius 2014 for its use.
 * Cost: 250 products per separation, once. Relative error 1e-12 (case PS-07).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <stdlib.h>
#include <string.h>

#include "fft/axis-transform.h"
#include "mollifier/mollifier.h"
#include "poisson-fft/fft-lattice.h"

extern const struct pm_mollifier mollifier_gaussian;

enum { L = PM_FFT_LINES, GAUSS = 16 };
static const double far_off = 1e6; /* t/h^2 from where K is expanded */

static double expanded(enum pm_symbol symbol, double i, double t, double h)
{
	double s = t / (h * h), x = i * i / (4 * s), c4 = symbol == PM_FD2 ? 1.0 / 12 : 0;
	return x > 700 ? 0 : exp(-x) / sqrt(4 * pm_pi * t) * (1 + 2 * c4 / s * (0.375 - 1.5 * x + 0.5 * x * x));
}

/* K of one axis at the nodes of a panel, one node per lane. */
static int heat_panel(struct pm_fft_plans *planner, enum pm_symbol symbol, size_t n, double h, const double *t, double *out)
{
	if (t[GAUSS - 1] > far_off * h * h) {
		for (size_t q = 0; q < GAUSS; q++)
			for (size_t i = 0; i <= n; i++)
				out[q * (n + 1) + i] = expanded(symbol, (double)i, t[q], h);
		return 0;
	}
	/* The period leaves exp(-r^2/4t) < 1e-17 between images; powers of 2 keep lengths few. */
	size_t half = 16;
	while (half < n + 8 || (double)(2 * half - n) < 13 * sqrt(t[GAUSS - 1]) / h)
		half *= 2;
	struct pm_transform line;
	const enum pm_face even[2] = {PM_NEUMANN, PM_NEUMANN};
	double *block = pm_alloc((2 * half + 1) * L, sizeof *block);
	if (!block || pm_transform_init(planner, even, half, &line))
		return pm_free(block), -PM_DATA;
	for (size_t k = 0; k <= half; k++) {
		double lambda = pm_symbol_value(symbol, pm_pi * (double)k / (double)half, h);
		for (size_t q = 0; q < L; q++)
			block[k * L + q] = exp(t[q] * lambda);
	}
	pm_transform_real(&line, block);
	for (size_t q = 0; q < GAUSS; q++)
		for (size_t i = 0; i <= n; i++)
			out[q * (n + 1) + i] = block[line.fft->at[i] * L + q] / (2 * (double)half * h);
	pm_free(block);
	return 0;
}

static int nodes(struct pm_lattice *l, double first, double last)
{
	gsl_error_handler_t *handler = gsl_set_error_handler_off(); /* GSL's own aborts where memory is short */
	gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(GAUSS);
	gsl_set_error_handler(handler);
	double low = 0, high = first;
	if (!table)
		return pm_no_memory();
	for (l->nodes = 0; low < last && l->nodes < PM_LATTICE_NODES; low = high, high *= 4)
		for (size_t i = 0; i < GAUSS; i++, l->nodes++)
			if (low > 0) { /* in ln t */
				gsl_integration_glfixed_point(log(low), log(high), i, &l->t[l->nodes], &l->w[l->nodes], table);
				l->t[l->nodes] = exp(l->t[l->nodes]);
				l->w[l->nodes] *= l->t[l->nodes];
			} else {
				gsl_integration_glfixed_point(low, high, i, &l->t[l->nodes], &l->w[l->nodes], table);
			}
	l->last = low;
	gsl_integration_glfixed_table_free(table);
	return 0;
}

/* Where the integral starts and ends. */
static void range(int dim, size_t ncases, const struct pm_green_case *cases, double *first, double *last)
{
	*first = INFINITY, *last = 0;
	for (int d = 0; d < dim; d++) {
		*first = fmin(*first, pow(cases->h[d], 2));
		*last = fmax(*last, 1e9 * pow(cases->h[d], 2));
	}
	for (size_t i = 0; i < ncases; i++)
		if (cases[i].kappa > 0) {
			*first = fmin(*first, pow(cases[i].kappa, -2));
			*last = fmax(*last, 50 * pow(cases[i].kappa, -2));
		}
}

static int weights(struct pm_lattice *l, size_t ncases, const struct pm_green_case *cases)
{
	if (!(l->weight = pm_alloc(ncases * l->nodes, sizeof *l->weight)))
		return -PM_DATA;
#pragma omp parallel for schedule(static) num_threads(pm_threads()) if (ncases > 64)
	for (size_t i = 0; i < ncases; i++)
		for (size_t q = 0; q < l->nodes; q++)
			l->weight[i * l->nodes + q] = l->w[q] * exp(-cases[i].kappa * cases[i].kappa * l->t[q]);
	return 0;
}

struct pm_lattice *pm_lattice_new(int dim, const size_t n[3], enum pm_symbol symbol, size_t ncases, const struct pm_green_case *cases)
{
	struct pm_lattice *l = calloc(1, sizeof *l);
	double first, last;
	if (!l) {
		pm_no_memory();
		return NULL;
	}
	l->dim = dim;
	range(dim, ncases, cases, &first, &last);
	l->t = pm_alloc(PM_LATTICE_NODES, sizeof *l->t);
	l->w = pm_alloc(PM_LATTICE_NODES, sizeof *l->w);
	if (!l->t || !l->w || nodes(l, first, last))
		return pm_lattice_free(l);
	int code = l->last < last ? pm_fail(PM_DATA, "the spacings, or they and the screening length, are too far apart for --green lattice (choose --symbol "
		"spectral)") :
		weights(l, ncases, cases);
	for (int d = 0; d < dim && !code; d++) {
		struct pm_fft_plans planner = {0};
		if (!(l->heat[d] = pm_alloc(l->nodes * (n[d] + 1), sizeof *l->heat[d])))
			code = -PM_DATA;
		for (size_t q = 0; q < l->nodes && !code; q += GAUSS)
			code = heat_panel(&planner, symbol, n[d], cases->h[d], l->t + q, l->heat[d] + q * (n[d] + 1));
		pm_fft_plans_clear(&planner);
	}
	return code ? pm_lattice_free(l) : l;
}

struct pm_lattice *pm_lattice_free(struct pm_lattice *l)
{
	if (!l)
		return NULL;
	pm_free(l->t);
	pm_free(l->w);
	pm_free(l->weight);
	for (int d = 0; d < 3; d++)
		pm_free(l->heat[d]);
	free(l);
	return NULL;
}

void pm_lattice_row(const struct pm_lattice *l, size_t n, const double *other, double *row)
{
	for (size_t q = 0; q < l->nodes; q++) {
		const double f = other[q], *heat = l->heat[0] + q * (n + 1);
		for (size_t i = 0; i <= n && f != 0; i++)
			row[i] -= f * heat[i];
	}
}

double pm_lattice_tail(const struct pm_lattice *l, double r2)
{
	return mollifier_gaussian.potential(r2, 2 * sqrt(l->last), l->dim);
}
