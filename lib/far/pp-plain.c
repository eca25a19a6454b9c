/* Direct summation by the plain double loop: the reference for the fast loops of pp.c. Compensated sums, one pair at a time through the
 * functions of the mollifier. Cost: N^2, 50 times that of the fast loops. SPDX-License-Identifier: GPL-3.0-or-later */
#include "far/pair-forces.h"
#include "far/pp.h"
#include "far/pp-vortex.h"
#include "far/vortex-pairs.h"

int pm_pp_plain(const struct pm_pp *p, size_t targets, size_t n, const double *const *x, const double *q, double *const *gradient,
	double *potential, uint64_t *coincident)
{
	*coincident = 0;
	for (size_t i = 0; i < targets; i++) {
		struct pm_sum g[3] = {{0}}, phi = {0};
		for (size_t j = 0; j < n; j++) {
			double s[3], r2 = 0;
			for (int d = 0; d < p->dim; d++)
				s[d] = x[d][i] - x[d][j], r2 += s[d] * s[d];
			if (j == i)
				continue;
			double f = p->mollifier->force(r2, p->delta, p->dim);
			for (int d = 0; d < p->dim; d++)
				pm_sum_add(&g[d], q[j] * f * s[d]);
			pm_sum_add(&phi, q[j] * p->mollifier->potential(r2, p->delta, p->dim));
			*coincident += j > i && r2 + (p->mollifier->bare ? 0 : p->delta * p->delta) < pm_pairs_least;
		}
		for (int d = 0; d < p->dim; d++)
			gradient[d][i] = pm_sum_total(g[d]);
		if (potential)
			potential[i] = pm_sum_total(phi);
	}
	return 0;
}

static void cross(const double a[3], const double b[3], double to[3])
{
	for (int d = 0; d < 3; d++)
		to[d] = a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* What vortex j does to i: velocity, rate of alpha_i, psi. */
static void vortex_pair(const struct pm_pp_vortex *p, const double s[3], const double a[3], const double b[3], double u[3], double rate[3], double psi[3])
{
	const double r2 = dot(s, s), f = p->mollifier->force(r2, p->delta, 3), slope = p->mollifier->slope(r2, p->delta);
	const double phi = p->mollifier->potential(r2, p->delta, 3);
	double t[3], turn[3];
	cross(b, s, t), cross(a, b, turn);
	for (int d = 0; d < 3; d++) {
		const double classical = slope * dot(a, s) * t[d] - f * turn[d], transpose = slope * dot(a, t) * s[d] + f * turn[d];
		u[d] = f * t[d], psi[d] = -b[d] * phi;
		rate[d] = p->form == PM_PP_CLASSICAL ? classical : p->form == PM_PP_TRANSPOSE ? transpose : 0.5 * (classical + transpose);
	}
}

int pm_pp_vortex_plain(const struct pm_pp_vortex *p, size_t targets, size_t n, const double *const x[3], const double *const alpha[3],
	struct pm_pp_vortex_sums *to)
{
	const bool point = p->mollifier->bare || p->delta * p->delta < pm_vortex_least;
	to->coincident = 0;
	for (size_t i = 0; i < targets; i++) {
		struct pm_sum sum[3][3] = {{{0}}};
		const double a[3] = {alpha[0][i], alpha[1][i], alpha[2][i]};
		for (size_t j = 0; j < n; j++) {
			const double s[3] = {x[0][i] - x[0][j], x[1][i] - x[1][j], x[2][i] - x[2][j]}, b[3] = {alpha[0][j], alpha[1][j], alpha[2][j]};
			double part[3][3];
			const bool same = point && dot(s, s) < pm_vortex_least;
			to->coincident += i != j && same;
			if (i == j || same)
				continue;
			vortex_pair(p, s, a, b, part[0], part[1], part[2]);
			for (int k = 0; k < 9; k++)
				pm_sum_add(&sum[k / 3][k % 3], part[k / 3][k % 3]);
		}
		for (int d = 0; d < 3; d++) {
			to->velocity[d][i] = pm_sum_total(sum[0][d]);
			if (p->form != PM_PP_NONE)
				to->stretching[d][i] = pm_sum_total(sum[1][d]);
			if (to->psi[0])
				to->psi[d][i] = pm_sum_total(sum[2][d]);
		}
	}
	return 0;
}
