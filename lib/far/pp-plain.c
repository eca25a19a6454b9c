/* Direct summation by the plain double loop: the reference for the fast loops of pp.c. Compensated sums, one pair at a time through the
 * functions of the mollifier. Cost: N^2, 50 times that of the fast loops. SPDX-License-Identifier: GPL-3.0-or-later */
#include "far/pair-forces.h"
#include "far/pp.h"

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
