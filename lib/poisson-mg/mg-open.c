/* Free space by James' method: the boundary values of a box from the charge that a grounded box would carry.
 *   A u = f with u = 0 on the walls; q = A u - f on the walls and f = A u beyond them; phi = -G * q on the walls; A phi = f with these
 * With G of the infinite lattice (mg-open-kernel.c) this is the solution of the differences on the infinite lattice, so its error is theirs alone, of order 2
 * or 4, and no domain is doubled. The source must vanish outside, at order 4 on the walls too. Sources: James 1977; Trottenberg, Oosterlee, Schueller 2001
 * for the solver. Cost: two solutions, and 100 N^3 operations for the walls; memory: four more grids in 3-D. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-open-parts.h"
#include "poisson-mg/mg-ranks.h"
#include "world/world.h"

#include <string.h>

enum { most_stretched = 8 };

struct pm_mg_open {
	struct pm_grid grid, walled;
	int order;
	struct pm_mg *mg;
	struct mg_walls *walls;
	double *f; /* of the points of the grid here */
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
		pm_mg_free(m->mg), pm_mg_walls_free(m->walls), pm_free(m->f);
	return pm_free(m);
}

struct pm_mg_open *pm_mg_open_new_planes(const struct pm_grid *g, int order, const struct pm_planes *planes)
{
	const bool divided = planes && planes->divided;
	struct pm_mg_open *m = pm_mg_open_check(g) ? NULL : pm_zalloc(1, sizeof *m);
	int status = pm_planes_agree(m ? 0 : pm_failed(), planes);
	if (status)
		return pm_mg_open_free(m);
	m->grid = *g;
	m->walled = pm_mg_walled(g);
	m->order = order;
	m->walls = pm_mg_walls_new(g, order, planes);
	m->mg = m->walls ? pm_mg_new_planes(&m->walled, order, planes) : NULL;
	m->f = pm_zalloc(divided ? planes->here * planes->size + 1 : pm_grid_size(g), sizeof *m->f);
	status = pm_planes_agree(m->walls && m->mg && m->f ? 0 : pm_failed(), planes);
	return status ? pm_mg_open_free(m) : m;
}

struct pm_mg_open *pm_mg_open_new(const struct pm_grid *g, int order) { return pm_mg_open_new_planes(g, order, NULL); }

bool pm_mg_open_fits(const struct pm_mg_open *m, const struct pm_grid *g, int order, const struct pm_planes *planes)
{
	for (int d = 0; d < g->dim; d++)
		for (int s = 0; s < 2; s++)
			if (g->face[d][s] != PM_OPEN)
				return false;
	const struct pm_grid walled = pm_mg_walled(g);
	return pm_mg_fits(m->mg, &walled, order) && pm_mg_same_planes(m->mg, planes);
}

/* The source of the differences: with zeros beyond the box. s has a plane more on either side where ranks share it. */
static void source(struct pm_mg_open *m, double c, const double *s)
{
	const struct pm_grid *g = &m->grid;
	const struct pm_planes *planes = pm_mg_walls_planes(m->walls);
	const size_t step[3] = {1, g->points[0], g->points[0] * g->points[1]}, first = pm_planes_row(planes, 0);
	#pragma omp parallel for num_threads(pm_threads()) if (planes->here * planes->size > mg_parallel)
	for (size_t row = 0; row < planes->here * planes->size / g->points[0]; row++)
		for (size_t i = 0; i < g->points[0]; i++) {
			const size_t at[3] = {i, (first + row) % g->points[1], (first + row) / g->points[1]}, p = i + row * g->points[0];
			double sum = 0;
			for (int d = 0; d < g->dim && m->order == 4; d++)
				sum += (at[d] ? *(s + p - step[d]) : 0) + (at[d] + 1 < g->points[d] ? s[p + step[d]] : 0) - 2 * s[p];
			m->f[p] = c * (s[p] + sum / 12);
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
	const struct pm_planes *planes = pm_mg_walls_planes(m->walls);
	struct pm_mg_record *first = pm_alloc(1, sizeof *first);
	double *copy = NULL, *room = pm_alloc(planes->here * planes->size + 1, sizeof *room);
	int status = pm_planes_agree(first && room ? 0 : pm_failed(), planes);
	if (m->order == 4 && planes->divided)
		status = pm_planes_halo(status, planes, 1, 1, &s, &s, &copy);
	if (!status) {
		source(m, c, s);
		status = pm_mg_solve_differences(m->mg, o, 1, m->f, NULL, phi, r);
	}
	pm_free(copy);
	if (!status) {
		*first = *r;
		status = pm_mg_walls_source(status, m->walls, phi, m->f, room);
	}
	if (!status) {
		status = pm_mg_solve_differences(m->mg, o, 1, m->f, NULL, phi, r);
		join(first, r);
	}
	if (!status)
		pm_mg_walls_set(m->walls, phi);
	pm_free(first), pm_free(room);
	return status;
}
