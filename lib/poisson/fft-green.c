/* Free-space Green's function of lap G = delta sampled on a mesh: 3-D -1/(4 pi r), 2-D ln r/(2 pi), 1-D |x|/2, and its value at r = 0.
 * The value at 0 makes the sum over nodes agree with the integral for smooth sources: sum_j h^d G(x-x_j) s_j differs from it by O(h^4) if G(0)
 * is minus the regularised sum of G over all other nodes. By Ewald's splitting, exact for any ratio of spacings (V = hx hy hz, A = hx hy):
 *   3-D, of 1/r:  Z = sum' erfc(a r)/r + (4 pi/V) sum' exp(-k^2/4a^2)/k^2 - pi/(a^2 V) - 2a/sqrt(pi)         cube: -2.8372974794806/h
 *   2-D, of -ln r: Z = sum' E1(a^2 r^2)/2 + (2 pi/A) sum' exp(-k^2/4a^2)/k^2 - pi/(2 a^2 A) - gamma/2 - ln a  square: ln h - 1.3105329259
 *   1-D: G(0) = h/12 (Euler and Maclaurin); with --symbol fd2 G(0) = 0, the exact inverse of the second difference.
 * Source: the corrected trapezoidal rules of Marin, Runborg and Tornberg 2014, constants as in Duan and Rokhlin 2009; Ewald 1921.
 * Hockney and Eastwood's 1/h for the cube, and the mean of ln r over a cell, leave O(h^2) (case PS-09). Cost: some thousand terms, once.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_sf_expint.h>

#include "poisson/fft.h"

double pm_green(int dim, double r2)
{
	if (dim == 3)
		return -1 / (4 * pm_pi * sqrt(r2));
	return dim == 2 ? log(r2) / (4 * pm_pi) : 0.5 * sqrt(r2);
}

/* Sum over a lattice without its origin of near(r^2), up to where it is below 1e-17. */
static double lattice(int dim, const double step[3], double reach, double (*term)(double r2, double a), double a)
{
	long most[3] = {0, 0, 0};
	for (int d = 0; d < dim; d++)
		most[d] = (long)ceil(reach / step[d]);
	struct pm_sum sum = {0, 0};
	for (long k = -most[2]; k <= most[2]; k++)
		for (long j = -most[1]; j <= most[1]; j++)
			for (long i = -most[0]; i <= most[0]; i++) {
				double x = (double)i * step[0], y = (double)j * step[1], z = (double)k * step[2];
				double r2 = x * x + y * y + z * z;
				if (r2 > 0 && r2 <= reach * reach)
					pm_sum_add(&sum, term(r2, a));
			}
	return pm_sum_total(sum);
}

static double near3(double r2, double a) { return erfc(a * sqrt(r2)) / sqrt(r2); }
static double near2(double r2, double a) { return 0.5 * gsl_sf_expint_E1(a * a * r2); }
static double far(double k2, double a) { return exp(-k2 / (4 * a * a)) / k2; }

double pm_green_centre(enum pm_symbol symbol, int dim, const double h[3])
{
	const double gamma = 0.57721566490153286;
	if (dim == 1)
		return symbol == PM_FD2 ? 0 : h[0] / 12;
	double cell = dim == 3 ? h[0] * h[1] * h[2] : h[0] * h[1];
	double a = sqrt(pm_pi) / (dim == 3 ? cbrt(cell) : sqrt(cell)), k[3] = {0, 0, 0};
	for (int d = 0; d < dim; d++)
		k[d] = 2 * pm_pi / h[d];
	/* erfc(6.2) and exp(-6.2^2) are below 2e-17. */
	if (dim == 3)
		return (lattice(3, h, 6.2 / a, near3, a) + 4 * pm_pi / cell * lattice(3, k, 12.4 * a, far, a) - pm_pi / (a * a * cell) -
			2 * a / sqrt(pm_pi)) / (4 * pm_pi);
	return (lattice(2, h, 6.2 / a, near2, a) + 2 * pm_pi / cell * lattice(2, k, 12.4 * a, far, a) - pm_pi / (2 * a * a * cell) - gamma / 2 -
		log(a)) / (2 * pm_pi);
}
