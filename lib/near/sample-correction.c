/* Partition of unity and reproducing kernels: u(x) = sum_p G_p (c_0 + c . z) zeta(z), z = (x - x_p)/eps, with c such that the sum is exact for a constant,
 * c_0 = 1/sum V zeta (Shepard 1968), or for linear functions as well: M c = (1, 0, ...), M the moments of V zeta of degree 0 to 2 (Liu, Jun and Zhang 1995,
 * Int. J. Numer. Meth. Fluids 20, 1081). M is a Gram matrix where zeta > 0: Cholesky. Where particles do not determine a slope (all on a line) only the
 * constant is exact. Conserves nothing. Cost: a system of dim + 1 a point. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "near/sample-correction.h"

const char *const pm_sample_correction_names[] = {"none", "unity", "linear", NULL};

/* Two widths beyond a straight rim a Gaussian sums to 0.023; in a corner of a cube it is 1/8. */
static const double hardly = 0.02;

/* c of M c = (1, 0, ...) by Cholesky; false: M is singular. */
static bool solve(int n, double m[4][4], double c[4])
{
	for (int j = 0; j < n; j++)
		for (int i = j; i < n; i++) {
			double s = m[i][j];
			for (int k = 0; k < j; k++)
				s -= m[i][k] * m[j][k];
			if (i == j && !(s > 1e-10 * m[0][0] * m[0][0]))
				return false;
			m[i][j] = i == j ? sqrt(s) : s / m[j][j];
		}
	for (int i = 0; i < n; i++) {
		c[i] = i ? 0 : 1;
		for (int k = 0; k < i; k++)
			c[i] -= m[i][k] * c[k];
		c[i] /= m[i][i];
	}
	for (int i = n - 1; i >= 0; i--) {
		for (int k = i + 1; k < n; k++)
			c[i] -= m[k][i] * c[k];
		c[i] /= m[i][i];
	}
	return true;
}

static double linear(int dim, size_t k, const double *const sum[], const double *const moment[])
{
	double m[4][4], c[4], u = 0;
	for (int i = 0, at = 0; i <= dim; i++)
		for (int j = i; j <= dim; j++)
			m[j][i] = moment[at++][k];
	if (!solve(dim + 1, m, c))
		return sum[0][k] / moment[0][k];
	for (int i = 0; i <= dim; i++)
		u += c[i] * sum[i][k];
	return u;
}

void pm_sample_correct(enum pm_sample_correction c, int dim, size_t n, const double *const sum[], const double *const moment[], double *u, size_t *bare)
{
	size_t few = 0;
#pragma omp parallel for schedule(static) reduction(+ : few)
	for (size_t k = 0; k < n; k++) {
		const bool there = moment[0][k] > hardly;
		few += !there;
		u[k] = !there ? sum[0][k] : c == PM_SAMPLE_LINEAR ? linear(dim, k, sum, moment) : sum[0][k] / moment[0][k];
	}
	*bare = few;
}
