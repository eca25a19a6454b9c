/* Chooses and keeps the multigrid solver of a grid: constant coefficient of order 2 or 4 (mg.c), the same in free space (mg-open.c), or variable
 * (mg-variable.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-open.h"
#include "poisson-mg/mg-ranks.h"
#include "world/world.h"

#include <string.h>

enum { kept = 4 }; /* kinds of faces that the components of a vector have: one for each axis as the normal one, and one for others */

struct pm_multigrid {
	struct pm_mg *constant[kept];
	struct pm_mg_open *open[kept];
	struct pm_mg_variable *variable[kept];
	int next; /* the one to be replaced next */
};

struct pm_multigrid *pm_multigrid_new(void) { return pm_zalloc(1, sizeof(struct pm_multigrid)); }

struct pm_multigrid *pm_multigrid_free(struct pm_multigrid *m)
{
	for (int i = 0; m && i < kept; i++)
		pm_mg_free(m->constant[i]), pm_mg_open_free(m->open[i]), pm_mg_variable_free(m->variable[i]);
	return pm_free(m);
}

int pm_multigrid_choose(struct pm_multigrid_choice *o, const char *smoother, double relaxation)
{
	o->cycle.smoother = o->order == 4 ? PM_MG_FOUR_COLOUR : o->variable || o->galerkin ? PM_MG_RED_BLACK : PM_MG_SOR;
	for (int i = 0; smoother && pm_mg_smoother_names[i]; i++)
		if (!strcmp(smoother, pm_mg_smoother_names[i]))
			o->cycle.smoother = (enum pm_mg_smoother)i;
	o->cycle.relaxation = relaxation; /* NAN: of the dimension, known with the grid */
	if (o->order == 4 && (o->cycle.smoother == PM_MG_RED_BLACK || o->cycle.smoother == PM_MG_SOR))
		return pm_fail(PM_USAGE, "two colours do not decouple the nodes of differences of order 4 (use --smoother four-colour or jacobi)");
	if (o->order == 4 && o->galerkin)
		return pm_fail(PM_USAGE, "Galerkin matrices are made of differences of order 2 (leave out --order 4, or --coarse galerkin)");
	if (o->galerkin && !o->variable)
		o->cycle.plain = true;
	if (o->order == 4 && o->variable)
		return pm_fail(PM_USAGE, "differences of order 4 need a constant coefficient (leave out --order 4, or --permittivity)");
	if ((o->variable || o->galerkin) && o->cycle.half_weighting)
		return pm_fail(PM_USAGE, "with --permittivity or --coarse galerkin the residual is restricted by the transpose of the interpolation (leave "
			"out --restriction half)");
	return 0;
}

static bool any_open(const struct pm_grid *g)
{
	bool any = false;
	for (int d = 0; d < g->dim; d++)
		any |= g->face[d][0] == PM_OPEN || g->face[d][1] == PM_OPEN;
	return any;
}

int pm_multigrid_check(const struct pm_multigrid_choice *o, const struct pm_grid *g)
{
	if (!any_open(g))
		return pm_mg_check(g);
	if (o->variable)
		return pm_fail(PM_DATA, "a permittivity that varies needs a box with walls, neumann or periodic faces, but these are open (pinit --faces "
			"neumann and "
			"a box large enough, "
			"or poisson-fft without a permittivity)");
	if (o->galerkin)
		return pm_fail(PM_DATA, "Galerkin matrices are for walls, neumann or periodic faces, but these are open (leave out --coarse galerkin)");
	return pm_mg_open_check(g);
}

static struct pm_mg *constant(struct pm_multigrid *m, const struct pm_multigrid_choice *o, const struct pm_grid *g)
{
	struct pm_planes planes = {.divided = false};
	struct pm_mg *mg = NULL;
	if (o->field && pm_planes_init(&planes, g, o->field))
		return NULL;
	for (int i = 0; i < kept && !mg; i++)
		if (m->constant[i] && pm_mg_fits(m->constant[i], g, o->order) && pm_mg_same_planes(m->constant[i], &planes))
			mg = m->constant[i];
	if (!mg) {
		pm_mg_free(m->constant[m->next]);
		mg = m->constant[m->next] = pm_mg_new_planes(g, o->order, &planes);
		m->next = (m->next + 1) % kept;
	}
	pm_planes_free(&planes);
	return mg;
}

/* Ranks make together what one of them lacks: rank 0 may have begun anew. */
static bool all_have(bool here, const struct pm_planes *planes)
{
	double lacks = !here;
	return !(planes->divided && pm_world_largest(0, 1, &lacks)) && lacks == 0;
}

static struct pm_mg_open *open_space(struct pm_multigrid *m, const struct pm_multigrid_choice *o, const struct pm_grid *g)
{
	struct pm_planes planes = {.divided = false};
	struct pm_mg_open *open = NULL;
	if (o->field && pm_planes_agree(pm_planes_init(&planes, g, o->field), &planes))
		return NULL;
	for (int i = 0; i < kept && !open; i++)
		if (m->open[i] && pm_mg_open_fits(m->open[i], g, o->order, &planes))
			open = m->open[i];
	if (!all_have(open, &planes)) {
		pm_mg_open_free(m->open[m->next]);
		open = m->open[m->next] = pm_mg_open_new_planes(g, o->order, &planes);
		m->next = (m->next + 1) % kept;
	}
	pm_planes_free(&planes);
	return open;
}

static struct pm_mg_variable *variable(struct pm_multigrid *m, const struct pm_multigrid_choice *o, const struct pm_grid *g, const double *eps)
{
	struct pm_planes planes = {.divided = false};
	struct pm_mg_variable *v = NULL;
	if (o->field && pm_planes_agree(pm_planes_init(&planes, g, o->field), &planes))
		return NULL;
	for (int i = 0; i < kept && !v; i++)
		if (m->variable[i] && pm_mg_variable_fits(m->variable[i], g, eps, o->mean) && pm_mg_variable_same_planes(m->variable[i], &planes))
			v = m->variable[i];
	if (!all_have(v, &planes)) {
		pm_mg_variable_free(m->variable[m->next]);
		v = m->variable[m->next] = pm_mg_variable_new_planes(g, eps, o->mean, &planes);
		m->next = (m->next + 1) % kept;
	}
	pm_planes_free(&planes);
	return v;
}

int pm_multigrid_prepare(struct pm_multigrid *m, const struct pm_multigrid_choice *o, const struct pm_grid *g, const double *eps)
{
	bool there = o->variable || o->galerkin ? variable(m, o, g, eps) != NULL : any_open(g) ? open_space(m, o, g) != NULL : constant(m, o, g) != NULL;
	return there ? 0 : pm_failed();
}

int pm_multigrid_solve(struct pm_multigrid *m, const struct pm_multigrid_choice *o, const struct pm_grid *g, const double *eps, double c, const double *s,
	double *phi,
	struct pm_mg_record *r)
{
	struct pm_mg_choice cycle = o->cycle;
	if (isnan(cycle.relaxation))
		cycle.relaxation = pm_mg_relaxation(cycle.smoother, g->dim, o->order);
	if (o->variable || o->galerkin) {
		struct pm_mg_variable *v = variable(m, o, g, eps);
		const int status = pm_world_agree(v ? 0 : pm_failed());
		return status ? status : pm_mg_variable_solve(v, &cycle, c, s, phi, r);
	}
	if (any_open(g)) {
		struct pm_mg_open *open = open_space(m, o, g);
		const int status = pm_world_agree(open ? 0 : pm_failed());
		return status ? status : pm_mg_open_solve(open, &cycle, c, s, phi, r);
	}
	struct pm_mg *mg = constant(m, o, g);
	const int status = pm_world_agree(mg ? 0 : pm_failed());
	return status ? status : pm_mg_solve(mg, &cycle, c, s, phi, r);
}
