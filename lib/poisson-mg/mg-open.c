/* Free space by James' method: the boundary values of a box from the charge that a grounded box would carry.
 *   A u = f with u = 0 on the walls; q = A u - f on the walls and f = A u beyond them; phi = -G * q on the walls; A phi = f with these
 * With G of the infinite lattice (mg-open-kernel.c) this is the solution of the differences on the infinite lattice, so its error is theirs alone, of order 2
 * or 4, and no domain is doubled. The source must vanish outside, at order 4 on the walls too. Sources: James 1977; Trottenberg, Oosterlee, Schueller 2001
 * for the solver. Cost: two solutions, and 100 N^3 operations for the walls; memory: four more grids in 3-D. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-open-parts.h"

#include <string.h>

enum { most_stretched = 8 };

struct pm_mg_open {
	struct pm_grid grid, walled;
	int order;
	struct pm_mg *mg;
	struct mg_stencil stencil;
	struct mg_faces *faces;
	double *f, *charge, *wall; /* of the points of the grid */
};

int pm_mg_open_check(const struct pm_grid *g)
{
	double least = INFINITY, most = 0;
	for (int d = 0; d < g->dim; d++) {
		least = fmin(least, g->h[d]), most = fmax(most, g->h[d]);
		if (g->face[d][0] != PM_OPEN || g->face[d][1] != PM_OPEN)
			return pm_fail(PM_DATA, "multigrid needs open faces on all axes or on none, but axis %c has %s ones (use poisson-fft)", "xyz"[d],
				pm_face_names[g->face[d][g->face[d][0] == PM_OPEN]]);
	}
	if (most > most_stretched * least * (1 + 1e-9))
		return pm_fail(PM_DATA, "multigrid in open space takes cells stretched up to %d times, and these are %.3g times longer than wide (choose "
			"p2m -n so that they are nearly cubes, "
			"or use poisson-fft)", most_stretched, most / least);
	return 0;
}

struct pm_mg_open *pm_mg_open_free(struct pm_mg_open *m)
{
	if (m)
		pm_mg_free(m->mg), pm_mg_faces_free(m->faces), pm_free(m->f), pm_free(m->charge), pm_free(m->wall);
	return pm_free(m);
}

static bool build(struct pm_mg_open *m)
{
	size_t n = pm_grid_size(&m->grid);
	m->walled = m->grid;
	for (int d = 0; d < m->grid.dim; d++)
		m->walled.face[d][0] = m->walled.face[d][1] = PM_WALL;
	m->stencil = pm_mg_stencil(&m->grid, m->order);
	m->f = pm_zalloc(n, sizeof(double));
	m->charge = pm_zalloc(n, sizeof(double));
	m->wall = pm_zalloc(n, sizeof(double));
	if (!m->f || !m->charge || !m->wall || pm_mg_lattice(&m->grid, m->order, m->f))
		return false;
	m->faces = pm_mg_faces_new(&m->grid, m->f);
	m->mg = pm_mg_new(&m->walled, m->order);
	return m->faces && m->mg;
}

struct pm_mg_open *pm_mg_open_new(const struct pm_grid *g, int order)
{
	struct pm_mg_open *m = pm_mg_open_check(g) ? NULL : pm_zalloc(1, sizeof *m);
	if (!m)
		return NULL;
	m->grid = *g;
	m->order = order;
	return build(m) ? m : pm_mg_open_free(m);
}

bool pm_mg_open_fits(const struct pm_mg_open *m, const struct pm_grid *g, int order)
{
	struct pm_grid walled = *g;
	for (int d = 0; d < g->dim; d++)
		for (int s = 0; s < 2; s++)
			if (walled.face[d][s] != PM_OPEN)
				return false;
			else
				walled.face[d][s] = PM_WALL;
	return pm_mg_fits(m->mg, &walled, order);
}

/* The source of the differences: with zeros beyond the box. */
static void source(struct pm_mg_open *m, double c, const double *s)
{
	const struct pm_grid *g = &m->grid;
	const size_t step[3] = {1, g->points[0], g->points[0] * g->points[1]};
	#pragma omp parallel for num_threads(pm_threads()) if (pm_grid_size(g) > mg_parallel)
	for (size_t row = 0; row < g->points[1] * g->points[2]; row++)
		for (size_t i = 0; i < g->points[0]; i++) {
			const size_t at[3] = {i, row % g->points[1], row / g->points[1]}, p = i + row * g->points[0];
			double sum = 0;
			for (int d = 0; d < g->dim && m->order == 4; d++)
				sum += (at[d] ? s[p - step[d]] : 0) + (at[d] + 1 < g->points[d] ? s[p + step[d]] : 0) - 2 * s[p];
			m->f[p] = c * (s[p] + sum / 12);
		}
}

/* The charge on the grounded box: A u - f on its walls; u is zero there. */
static void induced(struct pm_mg_open *m, const double *u)
{
	const struct pm_grid *g = &m->grid;
	const size_t step[3] = {1, g->points[0], g->points[0] * g->points[1]};
	#pragma omp parallel for num_threads(pm_threads()) if (pm_grid_size(g) > mg_parallel)
	for (size_t row = 0; row < g->points[1] * g->points[2]; row++)
		for (size_t i = 0; i < g->points[0]; i++) {
			const size_t at[3] = {i, row % g->points[1], row / g->points[1]}, p = i + row * g->points[0];
			bool wall = false;
			for (int d = 0; d < g->dim; d++)
				wall |= at[d] == 0 || at[d] + 1 == g->points[d];
			m->charge[p] = wall ? -m->f[p] : 0;
			for (int o = 0; o < m->stencil.n && wall; o++) {
				size_t to = 0;
				bool inside = true;
				for (int d = 0; d < 3; d++) {
					size_t x = at[d] + (size_t)(ptrdiff_t)m->stencil.shift[o][d];
					inside &= x < g->points[d];
					to += step[d] * x;
				}
				m->charge[p] += inside ? m->stencil.w[o] * u[to] : 0;
			}
		}
}

/* The record of two solutions, one after the other. */
static void join(const struct pm_mg_record *first, struct pm_mg_record *r)
{
	int room = PM_MG_MOST + 1 - r->n, n = first->n < room ? first->n : room;
	memmove(r->history + n, r->history, (size_t)r->n * sizeof *r->history);
	memcpy(r->history, first->history, (size_t)n * sizeof *r->history);
	r->n += n;
	r->cycles += first->cycles;
	r->floor |= first->floor;
	r->contraction = fmax(r->contraction, first->contraction);
}

int pm_mg_open_solve(struct pm_mg_open *m, const struct pm_mg_choice *o, double c, const double *s, double *phi, struct pm_mg_record *r)
{
	struct pm_mg_record *first = pm_alloc(1, sizeof *first);
	size_t n = pm_grid_size(&m->grid);
	int status = first ? 0 : -PM_DATA;
	source(m, c, s);
	if (!status)
		status = pm_mg_solve_differences(m->mg, o, 1, m->f, NULL, phi, r);
	if (!status) {
		*first = *r;
		induced(m, phi);
		memset(m->wall, 0, n * sizeof *m->wall);
		status = pm_mg_faces_apply(m->faces, m->charge, m->wall);
	}
	if (!status) {
		pm_mg_lift(&m->walled, &m->stencil, m->wall, m->f);
		status = pm_mg_solve_differences(m->mg, o, 1, m->f, NULL, phi, r);
		join(first, r);
	}
	for (size_t p = 0; p < n && !status; p++)
		phi[p] += m->wall[p]; /* phi is 0 there */
	pm_free(first);
	return status;
}
