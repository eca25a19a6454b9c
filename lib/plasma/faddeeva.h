/* The Faddeeva function w(z) = exp(-z^2) erfc(-i z) and the plasma dispersion function. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PLASMA_FADDEEVA_H
#define PM_PLASMA_FADDEEVA_H

#include <complex.h>

/* Anywhere in the complex plane, to 3e-14 of |w| where y >= 0; below, where w is 2 exp(-z^2) less a small part, to that of the larger; overflows to infinity
 * where it is above 1e308. */
double complex pm_faddeeva(double complex z);
/* Z(zeta) = i sqrt(pi) w(zeta) (Fried and Conte 1961), continued below the axis as Landau did; Z' = -2 (1 + zeta Z), without cancellation for large zeta. */
double complex pm_plasma_z(double complex zeta);
double complex pm_plasma_z_slope(double complex zeta);

#endif
