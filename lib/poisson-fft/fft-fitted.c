/* The harmonic function with given values on the faces of one axis, by separation: a mode of the other axes with eigenvalue -kappa^2 has along this axis the
 * profile f sinh(kappa (L-x))/sinh(kappa L) (walls), or -g cosh(kappa (L-x))/(kappa sinh(kappa L)) (g = du/dx at x = 0, neumann). On the nodes it solves
 *   u(x-h) - 2 u(x) + u(x+h) = 2 (cosh(kappa h) - 1) u(x),
 * so the known values of order 2 (poisson/boundary.c) and the multiplier 1/(lambda_fd2 - 2 (cosh(kappa h) - 1)/h^2), of neumann faces times
 * sinh(kappa h)/(kappa h), give its values without error and without a series in x. Source: separated series of textbooks (Haberman 2013, section 2.5).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-fft/fft-passes.h"

static double fitted(double lambda, double rest, double h, bool neumann)
{
	double a = h * sqrt(fabs(rest)), s = 2 * (rest < 0 ? sinh(0.5 * a) : sin(0.5 * a)) / h, sum = lambda - (rest < 0 ? s * s : -s * s);
	if (rest > 0) /* below the cut-off of a wave guide: sines in place of sinh */
		return sum != 0 ? (neumann ? sin(a) / a : 1) / sum : 0;
	if (neumann && a > 40) /* sinh a/(4 sinh^2(a/2)) = coth(a/2)/2 */
		return -0.5 * h * h / a;
	return sum < 0 ? (neumann && a > 0 ? sinh(a) / a : 1) / sum : 0;
}

int pm_poisson_fft_fitted(struct pm_poisson_fft *p)
{
	const int d = (p->choice.fitted - 1) / 2, axis = d == 0 ? X : p->grid.dim == 2 || d == 2 ? Z : Y;
	const double shift = p->choice.screening * p->choice.screening - p->choice.wave * p->choice.wave, h = p->grid.h[d];
	const bool neumann = (p->choice.fitted - 1) % 2;
	p->green_row = p->chunks * L;
	p->green_slab = p->green_row * p->modes[Z];
	size_t first, end;
	pm_poisson_fft_rows_here(p, &first, &end);
	p->green = pm_zalloc((end - first) * p->modes[Z] + 1, p->green_row * sizeof *p->green);
	p->fold = pm_alloc(p->modes[Y], sizeof *p->fold);
	if (!p->green || !p->fold)
		return -PM_DATA;
	for (size_t j = first; j < end; j++)
		p->fold[j] = j - first;
#pragma omp parallel for schedule(static) num_threads(pm_threads()) if (p->modes[Y] * p->green_slab > 16384)
	for (size_t r = 0; r < (end - first) * p->modes[Z]; r++)
		for (size_t i = 0; i < p->modes[X]; i++) {
			const double lambda[3] = {p->lambda[X][i], p->lambda[Y][first + r / p->modes[Z]], p->lambda[Z][r % p->modes[Z]] + shift};
			double rest = -shift;
			for (int a = X; a <= Z; a++)
				rest += a == axis ? 0 : lambda[a];
			p->green[r * p->green_row + i] = fitted(lambda[axis], rest, h, neumann);
		}
	return 0;
}
