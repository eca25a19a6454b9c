/* Free space by James' method for the solvers of the differences of order 2 (as multigrid has it, mg-open.c): the box is solved grounded, the charge on
 * its walls gives the potential there, and it is solved again with that:
 *   A u = f, u = 0 on the walls; q = A u - f on them; phi = -G*q on them; A phi = f inside
 * G is that of the infinite lattice, so the answer is the solution of the differences on all of it: the error is of order 2, whatever the size of the box.
 * Source: James 1977. The source vanishes outside. Cost: two solutions, and 100 N^3 operations for the walls. SPDX-License-Identifier: GPL-3.0-or-later */
#include "james/james.h"

#include "poisson-mg/mg-open-parts.h"

struct pm_james {
	struct mg_walls *walls;
	double *f; /* of the points here */
};

bool pm_james_wanted(const struct pm_grid *g)
{
	bool open = false;
	for (int d = 0; d < g->dim; d++)
		open = open || g->face[d][0] == PM_OPEN || g->face[d][1] == PM_OPEN;
	return open;
}

int pm_james_check(const struct pm_grid *g)
{
	for (int d = 0; d < g->dim; d++)
		if (g->face[d][0] != PM_OPEN || g->face[d][1] != PM_OPEN)
			return pm_fail(PM_DATA, "James' method needs open faces on all axes or on none, but axis %c has %s ones (poisson-fft "
				"--free-space doubled mixes them)", "xyz"[d], pm_face_names[g->face[d][g->face[d][0] == PM_OPEN]]);
	return pm_mg_open_check(g);
}

struct pm_grid pm_james_walled(const struct pm_grid *g) { return pm_mg_walled(g); }

struct pm_james *pm_james_new(const struct pm_grid *g, const struct pm_planes *planes)
{
	const size_t n = planes && planes->divided ? planes->here * planes->size + 1 : pm_grid_size(g);
	struct pm_james *o = pm_zalloc(1, sizeof *o);
	int status = pm_planes_agree(o && (o->f = pm_alloc(n, sizeof *o->f)) ? 0 : pm_failed(), planes);
	if (!status && !(o->walls = pm_mg_walls_new(g, 2, planes)))
		status = pm_failed();
	return status ? pm_james_free(o) : o;
}

struct pm_james *pm_james_free(struct pm_james *o)
{
	if (o)
		pm_mg_walls_free(o->walls), pm_free(o->f);
	return pm_free(o);
}

int pm_james_source(int status, struct pm_james *o, double c, const double *s, const double *u, double *room, const double **f)
{
	const struct pm_planes *p = pm_mg_walls_planes(o->walls);
	for (size_t i = 0; i < p->here * p->size; i++)
		o->f[i] = c * s[i];
	*f = o->f;
	return pm_mg_walls_source(status, o->walls, u, o->f, room);
}

void pm_james_set(const struct pm_james *o, double *phi) { pm_mg_walls_set(o->walls, phi); }
