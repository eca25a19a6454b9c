/* Arnoldi's iteration on matrices whose eigenvalues are known. SPDX-License-Identifier: GPL-3.0-or-later */
#include "check.h"
#include "modes/arnoldi.h"

enum { n = 400 };

/* Diagonal blocks: 1.25 and -1.15, a rotation by 0.7 times 1.1, the rest below 1; and a coupling above the diagonal, so that it is not normal. */
static int blocks(void *with, const double *in, double *out)
{
	int *calls = with;
	++*calls;
	for (int i = 0; i < n; i++)
		out[i] = i == 0 ? 1.25 * in[0] : i == 1 ? -1.15 * in[1] : 0.9 * cos(i) * in[i];
	out[2] = 1.1 * (cos(0.7) * in[2] - sin(0.7) * in[3]);
	out[3] = 1.1 * (sin(0.7) * in[2] + cos(0.7) * in[3]);
	for (int i = 0; i + 4 < n; i++)
		out[i] += 0.2 * in[i + 4];
	return 0;
}

static int fails(void *with, const double *in, double *out)
{
	(void)with, (void)in, (void)out;
	return pm_fail(PM_NUMERICS, "no");
}

/* |A y - lambda y| of the complex vector of a value. */
static double residual(struct pm_arnoldi *a, int k)
{
	static double re[n], im[n], ar[n], ai[n];
	int calls = 0;
	double s = 0;
	pm_arnoldi_vector(a, k, re, im);
	blocks(&calls, re, ar);
	blocks(&calls, im, ai);
	for (int i = 0; i < n; i++)
		s += pow(ar[i] - a->ritz[k].re * re[i] + a->ritz[k].im * im[i], 2) + pow(ai[i] - a->ritz[k].re * im[i] - a->ritz[k].im * re[i], 2);
	return sqrt(s);
}

int main(void)
{
	struct pm_arnoldi a;
	int calls = 0;
	int status = pm_arnoldi_run(&a, n, 120, 1e-10, 1, blocks, &calls);
	check(!status && a.values > 3 && calls < 120, "it stops before 120 vectors (%d)", calls);
	check(fabs(a.ritz[0].re - 1.25) < 1e-9 && a.ritz[0].im == 0, "the largest eigenvalue is 1.25 (%.12g)", a.ritz[0].re);
	check(fabs(a.ritz[1].re + 1.15) < 1e-6, "the second is -1.15 (%.12g)", a.ritz[1].re);
	check(fabs(a.ritz[2].re - 1.1 * cos(0.7)) < 1e-5 && fabs(a.ritz[2].im - 1.1 * sin(0.7)) < 1e-5,
		"a complex pair is listed once (%.9g, %.9g)", a.ritz[2].re, a.ritz[2].im);
	for (int k = 0; k < 3; k++)
		check(fabs(residual(&a, k) - a.ritz[k].residual) < 1e-12,
			"the residual of value %d is that of its vector (%.3g, said %.3g)", k + 1, residual(&a, k), a.ritz[k].residual);
	pm_arnoldi_free(&a);
	check(pm_arnoldi_run(&a, n, 5, 1e-10, 1, fails, NULL) == -PM_NUMERICS, "a map that fails ends it with its code");
	pm_arnoldi_free(&a);
	return check_done();
}
