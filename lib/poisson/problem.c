/* Determines the problem from options and law, and checks it. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "poisson/problem.h"
#include "stream/declare.h"

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
	p->c = isnan(names->coefficient) ? law->coefficient(f) : names->coefficient;
	return 0;
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
	p->target = pm_makes(f, p->mesh->name, p->target_name, p->source->components, PM_DERIVED);
	if (!p->target)
		return -PM_DATA;
	pm_field_inherit(p->target, p->source);
	if (p->own)
		pm_problem_not_of_law(p);
	return 0;
}

void pm_problem_not_of_law(struct pm_problem *p)
{
	if (p->target->outside == PM_OUTSIDE_MONOPOLE && *p->target->kernel)
		for (int d = 0; d < 2 * p->grid.dim; d++)
			if (p->grid.face[d / 2][d % 2] == PM_OPEN)
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

struct pm_grid pm_problem_grid(const struct pm_problem *p, int c)
{
	struct pm_grid g = p->grid;
	for (int d = 0; d < g.dim && p->source->components > 1 && p->wall != PM_ZERO_ALL; d++)
		for (int side = 0; side < 2; side++)
			if ((c == d) == (p->wall == PM_ZERO_TANGENTIAL) && (g.face[d][side] == PM_WALL || g.face[d][side] == PM_NEUMANN))
				g.face[d][side] = g.face[d][side] == PM_WALL ? PM_NEUMANN : PM_WALL;
	return g;
}
