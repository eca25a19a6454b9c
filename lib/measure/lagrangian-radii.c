/* Lagrangian radii: r_F is the smallest distance within which a fraction F of the mass lies. Particles at equal distance count in the order of
 * their index. Cost N log N. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "base/in-order.h"
#include "measure/measure.h"

static int nearer(const void *a, const void *b)
{
	const struct pm_shell *s = a, *t = b;
	if (s->r != t->r)
		return s->r < t->r ? -1 : 1;
	return s->index < t->index ? -1 : s->index > t->index;
}

static void make(const void *data, size_t from, size_t to, void *part)
{
	const struct pm_shell *shell = data;
	for (size_t i = from; i < to; i++)
		pm_sum_add(part, shell[i].mass);
}

/* The total is that of the stream; what lies within a radius is added from the centre outwards. */
void pm_radii(size_t n, struct pm_shell *shell, int nfractions, const double *fraction, double *radius)
{
	struct pm_sum total = {0};
	const struct pm_parts parts = {.size = sizeof total, .make = make, .join = pm_join_sums};
	pm_over_set(&parts, shell, n, &total);
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
