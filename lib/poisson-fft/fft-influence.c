/* An influence function (influence.c) in the layout of the multipliers of the transform solver: by frequency, one octant, as a Green's function of open
 * faces. Cost: a table of an eighth of the mesh, once. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-fft/fft-passes.h"
#include "poisson-fft/influence-table.h"

static double symbol(const void *choice, double theta, double h)
{
	return pm_symbol_value(((const struct pm_poisson_fft_choice *)choice)->symbol, theta, h);
}

/* fold: of each row of a plane of modes its mode j, then the place of that mode in the table, which has those of the rows of this rank alone (in 2-D all).
 * mode: the modes of the table, as many as are returned. */
static size_t held(const struct pm_poisson_fft *p, size_t modes, size_t *mode)
{
	size_t n = 0, first, end;
	pm_poisson_fft_rows_here(p, &first, &end);
	for (size_t j = 0; j < modes; j++) {
		bool here = false;
		for (size_t y = first; y < end; y++)
			here |= p->fold[y] == j;
		mode[n] = j;
		n += here;
	}
	for (size_t y = first; y < end; y++)
		for (size_t i = 0; i < n; i++)
			if (mode[i] == p->fold[y]) {
				p->fold[y] = i;
				break;
			}
	return n;
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
	p->green_row = (pm_poisson_fft_multipliers(p) + L - 1) / L * L;
	p->green_slab = p->green_row * axis[Z].count;
	size_t *mode = status ? NULL : pm_alloc(axis[Y].count + 1, sizeof *mode);
	p->fold = mode ? pm_alloc(p->modes[Y], sizeof *p->fold) : NULL;
	for (size_t i = 0, n = p->modes[Y]; i < n && p->fold; i++)
		p->fold[p->line[Y].fft->at[i]] = i <= n - i ? i : n - i;
	const size_t modes = p->fold ? held(p, axis[Y].count, mode) : 0;
	p->green = p->fold ? pm_zalloc(modes * p->green_slab + 1, sizeof *p->green) : NULL;
	status = status || p->green ? status : -PM_DATA;
	size_t rows = status ? 0 : modes * axis[Z].count;
#pragma omp parallel for schedule(dynamic, 4) num_threads(pm_threads()) if (rows * axis[X].count > 16384)
	for (size_t r = 0; r < rows; r++) {
		size_t j = r / axis[Z].count, k = r % axis[Z].count;
		pm_influence_row(f, axis, p->choice.screening * p->choice.screening, mode[j], k, p->green + j * p->green_slab + k * p->green_row);
	}
	pm_free(mode);
	for (int a = X; a <= Z; a++)
		pm_influence_axis_free(&axis[a]);
	return status;
}
