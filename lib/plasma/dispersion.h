/* Electrostatic waves of Maxwellian and cold species without a magnetic field. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PLASMA_DISPERSION_H
#define PM_PLASMA_DISPERSION_H

#include "base/base.h"
#include "plasma/faddeeva.h"

struct pm_wave_species {
	double frequency; /* [1/time] plasma frequency of this species alone */
	double drift, vth; /* [length/time] along k; vth 0: cold */
};

/* eps(omega, k) = 1 - sum frequency^2/(2 k^2 vth^2) Z'((omega - k drift)/(sqrt 2 k vth)); *slope its derivative by omega. */
double complex pm_dielectric(const struct pm_wave_species *s, int n, double k, double complex omega, double complex *slope);
/* Newton's method from a start; NAN where it does not converge to 1e-13. */
double complex pm_wave_root(const struct pm_wave_species *s, int n, double k, double complex start);
/* The root with the largest growth (least damping) that Newton's method finds from starts all over the frequencies of the species; NAN if none. */
double complex pm_wave_strongest(const struct pm_wave_species *s, int n, double k);
/* Among those roots the one nearest to a frequency that was measured, damped by less than half of it. */
double complex pm_wave_nearest(const struct pm_wave_species *s, int n, double k, double omega);

#endif
