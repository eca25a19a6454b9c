/* An influence function (influence.c) in the layout of the multipliers of the transform solver: by frequency, one octant, as a Green's function of open
 * faces. Cost: a table of an eighth of the mesh, once. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-fft/fft-passes.h"
#include "poisson-fft/influence-table.h"

static double symbol(const void *choice, double theta, double h)
{
	return pm_symbol_value(((const struct pm_poisson_fft_choice *)choice)->symbol, theta, h);
}

int pm_poisson_fft_influence(struct pm_poisson_fft *p)
{
	struct pm_influence made = p->choice.influence, *f = &made;
	const struct pm_grid *g = &p->grid;
	const double h[3] = {g->h[0], g->h[1], g->dim == 2 ? g->h[1] : g->h[2]};
	struct pm_influence_axis axis[3] = {{0}};
	int status = 0;
	if (p->choice.green && p->choice.green->factor)
		made.factor = p->choice.green->factor, made.softening = p->choice.softening;
	for (int a = X; a <= Z && !status; a++)
		status = pm_influence_axis_init(&axis[a], f, p->line[a].n, h[a], symbol, &p->choice);
	p->green_row = (p->chunks * H + L - 1) / L * L;
	p->green_slab = p->green_row * axis[Z].count;
	if (!status && (!(p->green = pm_zalloc(axis[Y].count * p->green_slab, sizeof *p->green)) || !(p->fold = pm_alloc(p->modes[Y], sizeof *p->fold))))
		status = -PM_DATA;
	for (size_t i = 0, n = p->modes[Y]; i < n && !status; i++)
		p->fold[p->line[Y].fft->at[i]] = i <= n - i ? i : n - i;
	size_t rows = status ? 0 : axis[Y].count * axis[Z].count;
#pragma omp parallel for schedule(dynamic, 4) num_threads(pm_threads()) if (rows * axis[X].count > 16384)
	for (size_t r = 0; r < rows; r++) {
		size_t j = r / axis[Z].count, k = r % axis[Z].count;
		pm_influence_row(f, axis, p->choice.screening * p->choice.screening, j, k, p->green + j * p->green_slab + k * p->green_row);
	}
	for (int a = X; a <= Z; a++)
		pm_influence_axis_free(&axis[a]);
	return status;
}
