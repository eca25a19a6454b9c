/* Electrostatic waves across a uniform magnetic field: the upper hybrid wave and Bernstein's modes. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PLASMA_BERNSTEIN_H
#define PM_PLASMA_BERNSTEIN_H

#include "plasma/magnetised.h"

/* eps(omega) = 1 - sum weight/(omega^2 - frequency^2) over the harmonics of all species, by ascending frequency. */
struct pm_bernstein {
	size_t n;
	struct pm_harmonic {
		double frequency, weight; /* [1/time], [1/time^2] */
	} *harmonic;
	double highest; /* [1/time] above every root */
};

/* exp(-x) I_0(x) ... exp(-x) I_n(x), x >= 0, to 1e-15 of the largest. */
void pm_bessel_scaled(double x, size_t n, double *value);
/* The species' drift is not looked at. 0 or failure: no memory. */
int pm_bernstein_init(struct pm_bernstein *b, const struct pm_gyrating *s, int n, double k);
void pm_bernstein_free(struct pm_bernstein *b);
double pm_bernstein_epsilon(const struct pm_bernstein *b, double omega, double *slope);
/* The one root between harmonic j and the next, j < n; of the last one above it. NAN: none. */
double pm_bernstein_root(const struct pm_bernstein *b, size_t j);
/* The root nearest to a frequency. */
double pm_bernstein_nearest(const struct pm_bernstein *b, double omega);
/* The root with the largest part of E after a displacement of the density: A_j = 2 (1 + k^2 lambda_D^2)/(omega_j eps'(omega_j)) of one species. */
double pm_bernstein_strongest(const struct pm_bernstein *b);

#endif
