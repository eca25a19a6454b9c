/* Helmholtz's equation lap phi + a^2 phi = c s in a closed box: phi^ = c s^/(lambda + a^2), which has no solution where a^2 is an eigenvalue of -lap.
 * The distance to the nearest, min |lambda + a^2|/a^2, is what round-off of s is divided by. Source: Morse and Feshbach 1953, section 7.2. Cost: once a look
 * at every mode. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-fft/fft-passes.h"

static const double least = 1e-8; /* half of the digits are lost */

int pm_poisson_fft_resonance(struct pm_poisson_fft *p)
{
	const double a2 = p->choice.wave * p->choice.wave;
	double nearest = INFINITY, at = 0;
	for (size_t i = p->modes[X]; i < pm_poisson_fft_multipliers(p); i++)
		p->lambda[X][i] = -INFINITY; /* no modes: nothing there is divided by zero */
	for (size_t k = 0; k < p->modes[Z]; k++)
		for (size_t j = 0; j < p->modes[Y]; j++)
			for (size_t i = 0; i < p->modes[X]; i++) {
				double sum = p->lambda[X][i] + (p->lambda[Y][j] + p->lambda[Z][k]);
				if (fabs(sum) < nearest)
					nearest = fabs(sum), at = a2 - sum;
			}
	p->distance = nearest / a2;
	if (p->distance >= least)
		return 0;
	return pm_fail(PM_NUMERICS, "--wave-number %g is at a resonance of this box: the wave number %.17g is an eigenvalue, at a distance of %.2g of a^2 (at "
		"least %g is needed)", p->choice.wave, sqrt(at), p->distance, least);
}

double pm_poisson_fft_distance(const struct pm_poisson_fft *p) { return p->distance; }
