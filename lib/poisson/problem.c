/* Determines the problem from options and law, and checks it. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "base/in-order.h"
#include "mesh/given-faces.h"
#include "poisson/problem.h"
#include "stream/declare.h"
#include "world/world.h"

const char *const pm_wall_rule_names[] = {"tangential", "normal", "all", NULL};

int pm_problem_find(const struct pm_frame *f, const struct pm_problem_names *names, struct pm_problem *p)
{
	const struct pm_law *law = pm_law_of(f);
	if (!law)
		return -PM_DATA;
	const struct pm_mesh *mesh = pm_frame_mesh(f, names->mesh);
	if (!mesh)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n makes one)", names->mesh ? " named " : "", names->mesh ? names->mesh : "");
	const char *source = names->source ? names->source : law->density, *target = names->target ? names->target : law->potential;
	if ((!source || !target) && law->evolves)
		return pm_fail(PM_USAGE, "the fields of the law %s have no potential (p2m --current | maxwell makes them, or give --source and --target)",
			law->name);
	if (!source || !target)
		return pm_fail(PM_USAGE, "the law %s names no density and potential (give --source and --target)", law->name);
	if (!strcmp(source, target))
		return pm_fail(PM_USAGE, "source and target are both '%s' (choose another --target)", source);
	if (isnan(names->coefficient) && !law->coefficient)
		return pm_fail(PM_USAGE, "the law %s has no coefficient (give --coefficient)", law->name);
	if (!pm_frame_field(f, mesh->name, source))
		return pm_fail(PM_DATA, "no field '%s' on '%s' (p2m makes it from particles, or choose --source)", source, mesh->name);
	*p = (struct pm_problem){.law = law, .mesh = mesh, .source_name = source, .target_name = target, .grid = pm_grid_of(f, mesh)};
	for (int i = 0; names->wall && pm_wall_rule_names[i]; i++)
		if (!strcmp(names->wall, pm_wall_rule_names[i]))
			p->wall = (enum pm_wall_rule)i;
	p->own = !isnan(names->coefficient) && !(law->coefficient && names->coefficient == law->coefficient(f));
	for (int a = 0; a < 2 * f->dim; a++)
		p->open |= p->grid.face[a / 2][a % 2] == PM_OPEN;
	p->c = isnan(names->coefficient) ? law->coefficient(f) : names->coefficient;
	return pm_given_find(&names->given, f, law, &p->grid, &p->given);
}

static void mark(struct pm_problem *p)
{
	for (int d = 0; d < p->grid.dim; d++)
		for (int side = 0; side < 2; side++)
			if (p->given.inside[d][side])
				pm_given_face_mark(p->target, d, side);
}

int pm_problem_declare(struct pm_frame *f, struct pm_problem *p)
{
	p->source = pm_reads(f, p->mesh->name, p->source_name);
	if (!p->source)
		return -PM_DATA;
	for (int c = 0; c < p->source->components; c++)
		for (int d = 0; d < f->dim; d++)
			if (p->source->staggered[c][d])
				return pm_fail(PM_DATA, "'%s' is staggered, but solvers work on the nodes (where p2m puts densities)", p->source_name);
	if (p->keep && pm_frame_field(f, p->mesh->name, p->target_name))
		p->target = pm_changes(f, p->mesh->name, p->target_name);
	else
		p->target = pm_makes(f, p->mesh->name, p->target_name, p->source->components, PM_DERIVED);
	if (!p->target)
		return -PM_DATA;
	pm_field_inherit(p->target, p->source);
	if (p->own || p->given.opened)
		pm_problem_not_of_law(p);
	mark(p);
	if (p->given.any && p->source->components > 1 && p->wall != PM_ZERO_ALL && !p->given.sum)
		return pm_fail(PM_USAGE, "boundary values of a vector need --wall all, where each component is a scalar");
	return pm_given_declare(&p->given, f, p->mesh->name, p->law, p->source);
}

void pm_problem_not_of_law(struct pm_problem *p)
{
	if (p->target->outside == PM_OUTSIDE_MONOPOLE && *p->target->kernel && p->open)
		p->target->outside = PM_OUTSIDE_ERROR;
}

int pm_problem_coefficient(struct pm_frame *f, const struct pm_problem *p, const char *name, const struct pm_field **field)
{
	if (!pm_frame_field(f, p->mesh->name, name))
		return pm_fail(PM_DATA, "no field '%s' on '%s' (scalc --mesh makes one: scalc --mesh %s '%s = 1 + x')", name, p->mesh->name, p->mesh->name,
			name);
	*field = pm_reads(f, p->mesh->name, name);
	if (!*field)
		return -PM_DATA;
	if ((*field)->components != 1 || (*field)->staggered[0][0] || (*field)->staggered[0][1] || (*field)->staggered[0][2])
		return pm_fail(PM_DATA, "'%s' must have one component, on the nodes (scalc --mesh makes such a field)", name);
	return 0;
}

int pm_problem_coefficient_values(const struct pm_problem *p, const struct pm_field *field, const double **values, double **room)
{
	struct pm_planes planes;
	int status = pm_planes_init(&planes, &p->grid, field);
	*values = pm_in(field, 0);
	*room = NULL;
	if (planes.divided)
		status = pm_planes_halo(status, &planes, 1, 1, values, values, room);
	pm_planes_free(&planes);
	return status;
}

struct pm_grid pm_problem_grid(const struct pm_problem *p, int c)
{
	struct pm_grid g = p->grid;
	for (int d = 0; d < g.dim && p->source->components > 1 && p->wall != PM_ZERO_ALL; d++)
		for (int side = 0; side < 2 && !p->given.sum; side++)
			if ((c == d) == (p->wall == PM_ZERO_TANGENTIAL) && (g.face[d][side] == PM_WALL || g.face[d][side] == PM_NEUMANN))
				g.face[d][side] = g.face[d][side] == PM_WALL ? PM_NEUMANN : PM_WALL;
	return g;
}

struct charges {
	const struct pm_grid *g;
	const double *s;
	size_t first; /* row of the mesh */
};

/* The charge of a row, and without its sign. */
static void make_charges(const void *data, size_t from, size_t to, void *part)
{
	const struct charges *c = data;
	const size_t row = c->first + from / (to - from), j = row % c->g->points[1], k = row / c->g->points[1];
	struct pm_sum *sum = part;
	for (size_t i = from; i < to; i++) {
		const double charge = pm_grid_weight(c->g, i - from, j, k) * c->s[i];
		pm_sum_add(&sum[0], charge);
		pm_sum_add(&sum[1], fabs(charge));
	}
}

/* The integrals whose difference a problem without walls must not have. */
static int integrals(int status, struct pm_homogeneous *m, double c, const double *s, const struct pm_boundary_eps *eps)
{
	const struct pm_grid *g = &m->boundary.grid;
	struct pm_sum sum[2] = {{0, 0}};
	const struct pm_parts parts = {.size = sizeof sum, .make = make_charges, .join = pm_join_sums};
	status = pm_planes_over(status, &m->planes, &parts, &(struct charges){g, s, pm_planes_row(&m->planes, 0)}, sum);
	m->charge = c * pm_grid_cell(g) * pm_sum_total(sum[0]);
	m->charge_absolute = fabs(c) * pm_grid_cell(g) * pm_sum_total(sum[1]);
	return pm_boundary_flux(status, &m->boundary, eps, &m->flux);
}

int pm_problem_move(const struct pm_problem *p, const struct pm_frame *f, int c, int order, const struct pm_boundary_eps *eps, struct pm_homogeneous *m)
{
	*m = (struct pm_homogeneous){.c = p->c, .s = pm_in(p->source, c), .boundary = {.grid = pm_problem_grid(p, c)}};
	if (!p->given.any)
		return 0;
	int status = pm_world_agree(pm_planes_init(&m->planes, &m->boundary.grid, p->source));
	const size_t n = m->planes.here * m->planes.size;
	m->boundary.planes = &m->planes;
	if (!status)
		status = pm_given_evaluate(&p->given, f, p->law, p->source, c, p->c, &m->boundary);
	if (!status && (!(m->source = pm_alloc(n + 1, sizeof(double))) || !(m->moved = pm_alloc(n + 1, sizeof(double)))))
		status = -PM_DATA;
	status = integrals(status, m, p->c, m->s, eps);
	if (status)
		pm_homogeneous_free(m);
	if (status || order == 0)
		return status;
	pm_boundary_known(&m->boundary, order, PM_BOUNDARY_ALL, eps, m->moved);
	for (size_t i = 0; i < n; i++)
		m->source[i] = p->c * m->s[i] - (order == 4 ? 0 : m->moved[i]);
	m->c = 1;
	m->s = m->source;
	m->known = order == 4 ? m->moved : NULL;
	return 0;
}

void pm_homogeneous_close(struct pm_homogeneous *m, double *phi)
{
	if (m->source)
		pm_boundary_set(&m->boundary, phi);
	pm_homogeneous_free(m);
}

void pm_homogeneous_free(struct pm_homogeneous *m)
{
	pm_boundary_free(&m->boundary);
	pm_planes_free(&m->planes);
	m->source = pm_free(m->source);
	m->moved = pm_free(m->moved);
}
