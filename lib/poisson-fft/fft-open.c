/* Open faces of the transform solver: the choice of Green's function, its limits, and its transform in the order of the solver's modes
 * (fft-octant.c). An axis open at both ends is doubled; one open at one end has its images at the other first (odd at a wall, even at a neumann
 * face), so sources reach over 2n cells and the length is 4n. Other axes keep their waves: to each the Green's function of lap - kappa^2 in the open
 * ones. Source: Hockney and Eastwood 1988, 6-5-4; Chatelain and Koumoutsakos 2010 for mixtures.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "poisson-fft/fft-octant.h"
#include "poisson-fft/fft-passes.h"
#include "world/world.h"

extern const struct pm_green green_hockney, green_lattice;

static bool open_line(const enum pm_face face[2]) { return face[0] == PM_OPEN || face[1] == PM_OPEN; }

const struct pm_green *pm_poisson_fft_green_of(const struct pm_poisson_fft_choice *o)
{
	return o->green ? o->green : o->symbol == PM_SPECTRAL ? &green_hockney : &green_lattice;
}

/* The names of the suitable methods, for a message. */
static const char *able(int open, bool screened, bool differences, char *text, size_t size)
{
	size_t n = 0;
	*text = 0;
	for (int i = 0; pm_greens[i] && n < size; i++)
		if (((screened ? pm_greens[i]->screened : pm_greens[i]->plain) >> open & 1) && pm_greens[i]->differences == differences)
			n += (size_t)snprintf(text + n, size - n, "%s%s", n ? ", " : "", pm_green_names[i]);
	return text;
}

int pm_poisson_fft_open_check(const struct pm_grid *g, const struct pm_poisson_fft_choice *o)
{
	const struct pm_green *green = pm_poisson_fft_green_of(o);
	int open = 0;
	char text[200];
	for (int d = 0; d < g->dim; d++)
		open += open_line(g->face[d]);
	if (green->factor && o->symbol != PM_SPECTRAL)
		return pm_fail(PM_DATA, "--green %s inverts the Laplacian, not its differences (leave out one of --symbol and --green)", green->name);
	if (!open)
		return o->green && !o->green->factor ? pm_fail(PM_DATA, "--green %s is for open faces, and there are none (leave it out)", o->green->name) : 0;
	if (o->softening > 0 && !green->regular)
		return pm_fail(PM_DATA, "--green %s has no softening (choose plummer, or gauss2, gauss4, gauss6, gauss8 or gauss10)", green->name);
	bool screened = open < g->dim || o->screening > 0, differences = o->symbol != PM_SPECTRAL;
	if (green->differences && !differences)
		return pm_fail(PM_DATA, "--green %s inverts differences (choose --symbol fd2, fd4 or fd6, or leave out one of --symbol and --green)",
			green->name);
	if (!green->differences && differences)
		return pm_fail(PM_DATA, "--green %s inverts the Laplacian, not its differences (leave out one of --symbol and --green)", green->name);
	if (!((screened ? green->screened : green->plain) >> open & 1))
		return pm_fail(PM_DATA, "--green %s does not take %d open of %d axes%s (choose %s)", green->name, open, g->dim,
			o->screening > 0 ? " with --screening" : "", able(open, screened, differences, text, sizeof text));
	return 0;
}

/* Row of frequencies in the octant for row number i of modes, in order. */
static size_t row_of(const struct pm_transform *l, size_t i)
{
	bool whole = l->face[0] == PM_PERIODIC || (l->face[0] == PM_OPEN && l->face[1] == PM_OPEN);
	return whole && i > l->length - i ? l->length - i : open_line(l->face) ? l->least + i : i;
}

static void axis(const struct pm_poisson_fft *p, int a, double h, struct pm_octant *o, double **lambda)
{
	const struct pm_transform *l = &p->line[a];
	bool open = open_line(l->face);
	int at = a == X ? 0 : a == Z ? 1 : 2; /* memory: y, z, x */
	size_t n = open ? l->length / 2 : l->face[0] == PM_PERIODIC ? l->length / 2 + 1 : l->modes;
	lambda[a] = open ? NULL : pm_poisson_fft_eigenvalues(l, n, n, false, p->choice.symbol, h);
	o->axis[at].open = open;
	o->axis[at].n = n;
	o->axis[at].h = h;
	o->axis[at].lambda = lambda[a];
}

/* In space each rank has the rows of its own pencils (j and 2n - j may have two owners, who both have it); fold becomes the place among these. */
static int held(struct pm_poisson_fft *p, size_t rows, struct pm_octant *o)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank();
	size_t *place = pm_alloc(rows, sizeof *place), n = 0;
	o->held = pm_alloc(p->modes[Y] + 1, sizeof *o->held), o->held_of = pm_alloc(ranks + 1, sizeof *o->held_of);
	if (!place || !o->held || !o->held_of)
		return pm_free(place), -PM_DATA;
	for (size_t r = 0; r < ranks; r++) {
		const size_t none = (size_t)-1;
		o->held_of[r] = n;
		for (size_t i = 0; i < rows; i++)
			place[i] = none;
		for (uint64_t j = p->units_of[r]; j < p->units_of[r + 1]; j++)
			place[p->fold[j]] = 0;
		for (size_t i = 0; i < rows; i++)
			if (place[i] != none)
				o->held[n] = i, place[i] = n++ - o->held_of[r];
		for (uint64_t j = p->units_of[r]; j < p->units_of[r + 1] && r == me; j++)
			p->fold[j] = place[p->fold[j]];
	}
	o->held_of[ranks] = n;
	pm_free(place);
	return 0;
}

int pm_poisson_fft_green(struct pm_poisson_fft *p)
{
	const struct pm_grid *g = &p->grid;
	const double h[3] = {g->h[0], g->h[1], g->dim == 2 ? g->h[1] : g->h[2]};
	struct pm_octant o = {.green = pm_poisson_fft_green_of(&p->choice), .symbol = p->choice.symbol, .screen2 = p->choice.screening * p->choice.screening};
	double *lambda[3] = {NULL, NULL, NULL};
	bool fine = true;
	for (int a = X; a <= Z; a++) {
		axis(p, a, h[a], &o, lambda);
		fine = fine && (lambda[a] || open_line(p->line[a].face));
	}
	for (int d = 0; d < g->dim; d++)
		o.width = fmax(o.width, open_line(g->face[d]) ? 2 * g->h[d] : 0); /* Hejlesen et al. 2013 */
	if (p->choice.softening > 0 || o.green->factor)
		o.width = p->choice.softening / (o.green->factor ? 1 : sqrt(2));
	o.rows = pm_poisson_fft_multipliers(p);
	o.row = (o.rows + L - 1) / L * L;
	o.map = pm_alloc(o.rows, sizeof *o.map);
	p->fold = pm_alloc(p->modes[Y], sizeof *p->fold);
	fine = fine && o.map && p->fold;
	for (size_t i = 0; fine && i < o.rows; i++)
		o.map[i] = i < p->modes[X] ? row_of(&p->line[X], i) : (size_t)-1;
	for (size_t i = 0; fine && i < p->modes[Y]; i++)
		p->fold[p->complex ? p->line[Y].fft->at[i] : i] = row_of(&p->line[Y], i);
	const bool some = p->from && g->dim == 3;
	fine = fine && !(some && held(p, o.axis[2].n + 1, &o));
	int status = some ? pm_world_agree(fine ? 0 : pm_failed()) : fine ? 0 : -PM_DATA;
	if (!status)
		status = pm_octant_spectrum(status, &o, &p->planner, &p->green);
	if (!status) {
		p->green_row = o.row;
		p->green_slab = o.row * o.axis[1].size;
		p->green_least = row_of(&p->line[Z], 0);
	}
	pm_free(o.map), pm_free(o.held), pm_free(o.held_of);
	for (int a = X; a <= Z; a++)
		pm_free(lambda[a]);
	return status;
}
