/* w(z) as the integral i/pi int exp(-t^2)/(z - t) dt by the midpoint or trapezoidal rule with twelve points, and the residue of the pole of exp(-z^2) between
 * its points. The rule whose points are farther from x is taken, so that neither part cancels. In the other quadrants by w(-z) = 2 exp(-z^2) - w(z) and
 * w(-conj z) = conj w(z).
 * Source: Matta and Reichel 1971, Math. Comput. 25, 339; Al Azah and Chandler-Wilde 2021, SIAM J. Numer. Anal. 59, 2346, equations 13-15.
 * Cost: twelve divisions. SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/base.h"
#include "plasma/faddeeva.h"

enum { POINTS = 11 };

/* x, y >= 0. */
static double complex first_quadrant(double complex z)
{
	const double h = sqrt(pm_pi / (POINTS + 1)), x = creal(z), y = cimag(z), part = x / h - floor(x / h);
	const bool trapezoids = y < x && part >= 0.25 && part <= 0.75;
	const double complex z2 = z * z;
	double complex sum = 0;
	for (int k = trapezoids; k <= POINTS; k++) {
		const double t = trapezoids ? k * h : (k + 0.5) * h;
		sum += exp(-t * t) / (z2 - t * t);
	}
	sum *= 2 * I * h * z / pm_pi;
	if (trapezoids)
		sum += I * h / (pm_pi * z);
	else if (y >= fmax(x, pm_pi / h))
		return sum;
	const double complex phase = cexp(-2 * I * pm_pi * z / h);
	return sum + 2 * cexp(-z2) / (trapezoids ? 1 - phase : 1 + phase);
}

double complex pm_faddeeva(double complex z)
{
	const double x = creal(z), y = cimag(z);
	const double complex w = first_quadrant(fabs(x) + I * fabs(y)), above = x < 0 ? conj(w) : w;
	/* below the axis: of the mirror image in the origin, which has -x */
	return y >= 0 ? above : 2 * cexp(-z * z) - conj(above);
}

double complex pm_plasma_z(double complex zeta) { return I * sqrt(pm_pi) * pm_faddeeva(zeta); }

double complex pm_plasma_z_slope(double complex zeta)
{
	if (cabs(zeta) < 40)
		return -2 * (1 + zeta * pm_plasma_z(zeta));
	/* 1 + zeta Z = -1/(2 zeta^2) - 3/(4 zeta^4) - ... far out; below the axis with the residue */
	const double complex q = 0.5 / (zeta * zeta), series = 2 * q * (1 + 3 * q * (1 + 5 * q * (1 + 7 * q * (1 + 9 * q))));
	return cimag(zeta) < 0 ? series - 4 * I * sqrt(pm_pi) * zeta * cexp(-zeta * zeta) : series;
}
