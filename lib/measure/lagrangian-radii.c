/* Lagrangian radii: r_F is the smallest distance within which a fraction F of the mass lies. Particles at equal distance count in the order of
 * their index. Cost N log N. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "measure/measure.h"

static int nearer(const void *a, const void *b)
{
	const struct pm_shell *s = a, *t = b;
	if (s->r != t->r)
		return s->r < t->r ? -1 : 1;
	return s->index < t->index ? -1 : s->index > t->index;
}

void pm_radii(size_t n, struct pm_shell *shell, int nfractions, const double *fraction, double *radius)
{
	struct pm_sum total = {0};
	for (size_t i = 0; i < n; i++)
		pm_sum_add(&total, shell[i].mass);
	qsort(shell, n, sizeof *shell, nearer);
	for (int k = 0; k < nfractions; k++) {
		/* a few units of rounding below, so that fraction 1 and fractions that are multiples of 1/n give the expected particle */
		const double want = fraction[k] * pm_sum_total(total) * (1 - 1e-14);
		struct pm_sum within = {0};
		radius[k] = NAN;
		for (size_t i = 0; i < n && isnan(radius[k]); i++) {
			pm_sum_add(&within, shell[i].mass);
			if (pm_sum_total(within) >= want)
				radius[k] = shell[i].r;
		}
	}
}
