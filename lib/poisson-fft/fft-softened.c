/* The multipliers of a softened Green's function where faces are walls, neumann or periodic and none is open: factor(q epsilon)/(lambda - K^2), lambda = -k^2,
 * q^2 = K^2 - lambda, for every mode in the order of the solver. The images of walls are softened like the sources, so their fields are exact too.
 * Cost: a table as large as the mesh, once. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-fft/fft-passes.h"

int pm_poisson_fft_softened(struct pm_poisson_fft *p)
{
	const struct pm_poisson_fft_choice *o = &p->choice;
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
	for (size_t r = 0; r < (end - first) * p->modes[Z]; r++) {
		double rest = p->lambda[Y][first + r / p->modes[Z]] + p->lambda[Z][r % p->modes[Z]], *row = p->green + r * p->green_row;
		for (size_t i = 0; i < p->modes[X]; i++) {
			double sum = p->lambda[X][i] + rest;
			row[i] = sum < 0 ? o->green->factor(sqrt(-sum) * o->softening) / sum : 0; /* 0: the mode of constants of a singular problem */
		}
	}
	return 0;
}
