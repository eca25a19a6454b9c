/* The level of a set of a frame, measured and made a distance. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "level/level-frame.h"
#include "stream/declare.h"
#include "stream/parts.h"
#include "world/world.h"

static struct pm_grid even_grid(const struct pm_frame *f, const struct pm_mesh *m)
{
	struct pm_grid g = pm_grid_of(f, m);
	pm_grid_even(&g);
	return g;
}

static const char *first_set(const struct pm_frame *f, const char *field)
{
	for (size_t i = 0; i < f->nsets; i++)
		if (pm_frame_field(f, f->sets[i]->name, field))
			return f->sets[i]->name;
	return NULL;
}

/* Real numbers, one for each particle. */
static bool scalar(const struct pm_field *field) { return field && field->components == 1 && (field->type == PM_F64 || field->type == PM_F32); }

int pm_level_declare(struct pm_frame *f, const char **set, const char *field, const char *mesh)
{
	if (!*set)
		*set = first_set(f, field);
	if (!*set || !pm_frame_set(f, *set))
		return pm_fail(PM_DATA, "no set%s%s with the level '%s' (scalc 'level = hypot(x, y) - 1' makes one)", *set ? " " : "", *set ? *set : "", field);
	if (!pm_frame_mesh(f, mesh))
		return pm_fail(PM_DATA, "no mesh%s%s on which the interface is found (p2m -n CELLS makes one)", mesh ? " " : "", mesh ? mesh : "");
	if (!pm_frame_field(f, *set, "volume"))
		return pm_fail(PM_DATA, "no field 'volume' on '%s' (scalc --extensive 'volume = ...', or remesh)", *set);
	if (!scalar(pm_frame_field(f, *set, field)) || !scalar(pm_frame_field(f, *set, "volume")))
		return pm_fail(PM_DATA, "'%s' and 'volume' on '%s' are real numbers of one component", field, *set);
	return pm_reads(f, *set, "x") && pm_reads(f, *set, "volume") && pm_changes(f, *set, field) ? 0 : -PM_DATA;
}

/* The planes of a mesh on this rank, divided where the particles are. */
static int planes_of(const struct pm_frame *f, const char *set, const struct pm_grid *g, const struct pm_mesh *m, struct pm_planes *p)
{
	struct pm_field nodes = {.count = pm_grid_size(g)};
	const bool shared = pm_frame_field(f, set, "x")->here;
	int status = shared ? pm_field_share(&nodes, pm_division_grain(f, m->name)) : 0;
	*p = (struct pm_planes){.from = NULL};
	status = status ? status : pm_planes_init(p, g, &nodes);
	free((void *)(uintptr_t)nodes.from);
	return shared ? pm_world_agree(status) : status;
}

static int on_mesh(const struct pm_frame *f, const char *set, const char *field, const struct pm_grid *g, const struct pm_planes *planes, double **node)
{
	const struct pm_field *at = pm_frame_field(f, set, "x");
	const double *x[3] = {NULL};
	for (int d = 0; d < f->dim; d++)
		x[d] = pm_in(at, d);
	*node = pm_alloc(planes->here * planes->size + 1, sizeof **node);
	const int status = pm_planes_agree(*node ? 0 : -PM_DATA, planes);
	if (status)
		return status;
	return pm_level_on_mesh(g, planes, at->count, x, pm_in(pm_frame_field(f, set, "volume"), 0), pm_in(pm_frame_field(f, set, field), 0), *node);
}

int pm_level_redistance(struct pm_frame *f, const char *set, const char *field, const char *mesh, struct pm_redistance *made)
{
	const struct pm_mesh *m = pm_frame_mesh(f, mesh);
	const struct pm_grid g = even_grid(f, m);
	const double *x[3] = {NULL};
	double *node = NULL;
	struct pm_planes planes;
	set = set ? set : first_set(f, field);
	int status = planes_of(f, set, &g, m, &planes);
	status = status ? status : on_mesh(f, set, field, &g, &planes, &node);
	for (size_t i = 0; i < pm_grid_size(&g) && !status; i++)
		if (isnan(node[i]))
			status = pm_fail(PM_DATA, "node %zu of mesh '%s' has no particle near it, so '%s' is not known there (particles must fill the mesh: "
				"remesh --by volume)", i, m->name, field);
	for (int d = 0; d < f->dim; d++)
		x[d] = pm_in(pm_frame_field(f, set, "x"), d);
	struct pm_field *level = pm_frame_field(f, set, field);
	if (!status)
		status = pm_redistance(&g, node, level->count, x, pm_out(level, 0), made);
	pm_free(node), pm_planes_free(&planes);
	return status;
}

static bool measured(const struct pm_frame *f, const char *set, const char *only)
{
	return (!only || !strcmp(only, set)) && scalar(pm_frame_field(f, set, "level")) && scalar(pm_frame_field(f, set, "volume")) &&
		pm_frame_field(f, set, "x");
}

bool pm_level_there(const struct pm_frame *f, const char *only)
{
	bool there = false;
	for (size_t i = 0; i < f->nsets; i++)
		there = there || measured(f, f->sets[i]->name, only);
	return there && pm_frame_mesh(f, NULL);
}

void pm_level_reads(struct pm_frame *f, const char *only)
{
	const char *const names[] = {"x", "volume", "level", "exact_level"};
	for (size_t i = 0; i < f->nsets && pm_frame_mesh(f, NULL); i++)
		for (int k = 0; k < 4 && measured(f, f->sets[i]->name, only); k++)
			if (pm_frame_field(f, f->sets[i]->name, names[k]))
				pm_reads(f, f->sets[i]->name, names[k]);
}

/* exact on the nodes; *node stays NULL where it is not known at this time. */
static int exact_on_mesh(const struct pm_frame *f, const struct pm_grid *g, const struct pm_planes *planes, pm_level_function *exact, double **node)
{
	const size_t n = planes->here * planes->size;
	if (!exact || isnan(exact(f, g->lo, f->time)))
		return 0;
	*node = pm_alloc(n + 1, sizeof **node);
	for (size_t i = 0; i < n && *node; i++) {
		const size_t row = pm_planes_row(planes, i), at[3] = {i % g->points[0], row % g->points[1], row / g->points[1]};
		double x[3];
		for (int d = 0; d < 3; d++)
			x[d] = d < g->dim ? g->lo[d] + (double)at[d] * g->h[d] : 0;
		(*node)[i] = exact(f, x, f->time);
	}
	return pm_planes_agree(*node ? 0 : -PM_DATA, planes);
}

int pm_level_of(const struct pm_frame *f, const char *only, pm_level_function *exact, struct pm_level_measures *m)
{
	*m = (struct pm_level_measures){NAN, NAN, NAN};
	if (!pm_level_there(f, only))
		return 0;
	*m = (struct pm_level_measures){0, 0, 0};
	const struct pm_grid g = even_grid(f, pm_frame_mesh(f, NULL));
	int status = 0;
	for (size_t i = 0; i < f->nsets && !status; i++) {
		const char *set = f->sets[i]->name;
		double *a = NULL, *b = NULL;
		struct pm_level_measures one;
		struct pm_planes planes;
		if (!measured(f, set, only))
			continue;
		status = planes_of(f, set, &g, pm_frame_mesh(f, NULL), &planes);
		status = status ? status : on_mesh(f, set, "level", &g, &planes, &a);
		if (!status && scalar(pm_frame_field(f, set, "exact_level")))
			status = on_mesh(f, set, "exact_level", &g, &planes, &b);
		else if (!status)
			status = exact_on_mesh(f, &g, &planes, exact, &b);
		status = status ? status : pm_level_measure(&g, &planes, a, b, &one);
		if (!status)
			m->inside += one.inside, m->interface += one.interface, m->difference += one.difference;
		pm_free(a), pm_free(b), pm_planes_free(&planes);
	}
	return status;
}
