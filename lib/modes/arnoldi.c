/* Arnoldi's iteration: an orthonormal basis V of span(b, A b, A^2 b, ...) by Gram-Schmidt, done twice; A V = V H + h v e^T with a Hessenberg matrix H, whose
 * eigenvalues approach those of A of largest magnitude (Arnoldi 1951; Saad, Numerical methods for large eigenvalue problems, 2011, section 6.2). The
 * residual of a pair is h |last component|. Eigenvalues of H by GSL. Cost: one A and 4 n k operations for vector k; no restarts.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>

#include "modes/arnoldi.h"

enum { look_every = 8 }; /* vectors */
static const double broken = 1e-7; /* times the length of A v: what is left is the error of differences (1e-9 to 1e-8), not a direction */

static double dot(const double *a, const double *b, size_t n)
{
	double s = 0;
	for (size_t i = 0; i < n; i++)
		s += a[i] * b[i];
	return s;
}

static void add(double *a, double factor, const double *b, size_t n)
{
	for (size_t i = 0; i < n; i++)
		a[i] += factor * b[i];
}

static void start(double *v, size_t n, uint64_t seed)
{
	for (size_t i = 0; i < n; i++) {
		double u[2];
		pm_random(seed, i, 0, u);
		v[i] = u[0] - 0.5;
	}
	const double length = sqrt(dot(v, v, n));
	for (size_t i = 0; i < n; i++)
		v[i] /= length;
}

/* The eigenvalues of the k x k matrix h (columns of length k + 1 in storage of `most` + 1), into a. */
static int solve(struct pm_arnoldi *a, const double *h, int most, int k, double next)
{
	gsl_error_handler_t *handler = gsl_set_error_handler_off();
	gsl_matrix *m = gsl_matrix_alloc((size_t)k, (size_t)k);
	gsl_vector_complex *value = gsl_vector_complex_alloc((size_t)k);
	gsl_matrix_complex *vector = gsl_matrix_complex_alloc((size_t)k, (size_t)k);
	gsl_eigen_nonsymmv_workspace *w = gsl_eigen_nonsymmv_alloc((size_t)k);
	int status = m && value && vector && w ? 0 : pm_no_memory();
	for (int i = 0; i < k && !status; i++)
		for (int j = 0; j < k; j++)
			gsl_matrix_set(m, (size_t)i, (size_t)j, i <= j + 1 ? h[(size_t)j * (size_t)(most + 1) + (size_t)i] : 0);
	if (!status && (gsl_eigen_nonsymmv(m, value, vector, w) || gsl_eigen_nonsymmv_sort(value, vector, GSL_EIGEN_SORT_ABS_DESC)))
		status = pm_fail(PM_NUMERICS, "the eigenvalues of a %d x %d matrix do not converge", k, k);
	a->vectors = k;
	a->values = 0;
	for (int j = 0; j < k && !status; j++) {
		const gsl_complex z = gsl_vector_complex_get(value, (size_t)j);
		if (GSL_IMAG(z) < 0) /* the partner of one that is listed */
			continue;
		double *c = a->coefficient + (size_t)a->values * 2 * (size_t)k;
		for (int i = 0; i < k; i++) {
			const gsl_complex y = gsl_matrix_complex_get(vector, (size_t)i, (size_t)j);
			c[i] = GSL_REAL(y);
			c[k + i] = GSL_IMAG(y);
		}
		a->ritz[a->values++] = (struct pm_ritz){GSL_REAL(z), GSL_IMAG(z), next * hypot(c[k - 1], c[2 * k - 1])};
	}
	gsl_eigen_nonsymmv_free(w);
	gsl_matrix_complex_free(vector);
	gsl_vector_complex_free(value);
	gsl_matrix_free(m);
	gsl_set_error_handler(handler);
	return status;
}

/* Makes v orthogonal to the k vectors before it, and adds the coefficients to h; the length that is left. */
static double orthogonal(const double *basis, size_t n, int k, double *v, double *h)
{
	for (int twice = 0; twice < 2; twice++)
		for (int i = 0; i < k; i++) {
			const double c = dot(basis + (size_t)i * n, v, n);
			h[i] += c;
			add(v, -c, basis + (size_t)i * n, n);
		}
	return sqrt(dot(v, v, n));
}

int pm_arnoldi_run(struct pm_arnoldi *a, size_t n, int most, double tolerance, uint64_t seed, pm_linear_map map, void *with)
{
	int good = 0, status = 0;
	if ((size_t)most > n)
		most = (int)n;
	const size_t column = (size_t)most + 1;
	*a = (struct pm_arnoldi){.n = n, .basis = pm_alloc(column * n, sizeof(double)), .ritz = pm_alloc(column, sizeof(struct pm_ritz)),
		.coefficient = pm_alloc(2 * column * column, sizeof(double))};
	double *h = pm_zalloc(column * column, sizeof(double));
	if (!a->basis || !a->ritz || !a->coefficient || !h)
		status = pm_no_memory();
	else
		start(a->basis, n, seed);
	for (int k = 0; k < most && !status && good < 2 && !a->whole; k++) {
		double *v = a->basis + ((size_t)k + 1) * n, *c = h + (size_t)k * column;
		status = map(with, a->basis + (size_t)k * n, v);
		if (status)
			break;
		const double length = sqrt(dot(v, v, n)), left = orthogonal(a->basis, n, k + 1, v, c);
		c[k + 1] = left;
		a->whole = left <= broken * length || (size_t)k + 1 == n;
		if (a->whole || k + 1 == most || (k + 1) % look_every == 0) {
			status = solve(a, h, most, k + 1, a->whole ? 0 : left);
			if (!status)
				good = a->ritz->residual <= tolerance * hypot(a->ritz->re, a->ritz->im) ? good + 1 : 0;
		}
		for (size_t i = 0; i < n && left > 0; i++)
			v[i] /= left;
	}
	pm_free(h);
	return status;
}

void pm_arnoldi_vector(const struct pm_arnoldi *a, int value, double *re, double *im)
{
	const double *c = a->coefficient + (size_t)value * 2 * (size_t)a->vectors;
	memset(re, 0, a->n * sizeof *re);
	memset(im, 0, a->n * sizeof *im);
	for (int i = 0; i < a->vectors; i++) {
		add(re, c[i], a->basis + (size_t)i * a->n, a->n);
		add(im, c[a->vectors + i], a->basis + (size_t)i * a->n, a->n);
	}
}

void pm_arnoldi_free(struct pm_arnoldi *a)
{
	pm_free(a->basis);
	pm_free(a->ritz);
	pm_free(a->coefficient);
}
