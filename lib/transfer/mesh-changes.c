/* Changes from the mesh to particles: d(strength)_p += volume_p sum over points of W((x_p - x_i)/h) d(density)_i / D_i, with the overlap of the particles at
 * the point, D_i = sum over particles of volume_p W((x_p - x_i)/h) / cell, 1 on a lattice; without volume and D where the state is a value.
 * The sum over the particles then equals that over the mesh for any positions, and several sets share it by their volumes. Where D is below a
 * half (the edge of a patch; gaps; negative lobes) D = 1 is used, and the part that no particle receives is summed: cell (1 - D) d(density) over those points.
 * Source: Cottet and Koumoutsakos 2000, section 5.5, for D = 1. Cost: a spread, and the changes are gathered together with the law's field.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "transfer/mesh-changes.h"
#include "base/in-order.h"
#include "mesh/planes.h"
#include "stream/declare.h"
#include "stream/limits.h"
#include "transfer/on-nodes.h"
#include "world/world.h"

bool pm_mesh_change_concerns(const struct pm_frame *f, const char *set, const struct pm_mesh *m, const struct pm_field *c)
{
	const struct pm_field *state = c->role == PM_CHANGE && !strcmp(c->on, m->name) && c->of[0] ? pm_frame_field(f, set, c->of) : NULL;
	return state && state->role == PM_STATE;
}

static void target_name(const struct pm_field *change, char name[PM_NAME]) { snprintf(name, PM_NAME, "d%.62s", change->of); }

static int plan_field(struct pm_frame *f, const char *set, struct pm_field *change, bool replace)
{
	char name[PM_NAME];
	struct pm_field *to = NULL;
	bool strength = pm_frame_field(f, set, change->of)->extensive;
	if (strength && !pm_frame_field(f, set, "volume"))
		return pm_fail(PM_DATA, "'%s' on '%s' is a strength: its change '%s' on the mesh must be multiplied by a 'volume', and there is none (scalc "
			"makes one, or a column volume in the table)", change->of, set, change->name);
	if (strength && !pm_reads(f, set, "volume"))
		return -PM_DATA;
	target_name(change, name);
	change->use |= PM_USE_READ;
	for (int t = 0; t < change->nterms; t++, replace = false)
		if (!(to = pm_contributes(f, set, name, change->of, change->components, change->terms[t], replace)))
			return -PM_DATA;
	if (to)
		to->extensive = strength;
	return 0;
}

int pm_mesh_changes_declare(struct pm_frame *f, const char *set, const struct pm_mesh *m, bool replace)
{
	struct pm_field *fields[PM_MESH_CHANGES]; /* contributing reorders the frame's list */
	int n = 0, status = 0;
	for (size_t i = 0; i < f->nfields; i++)
		if (pm_mesh_change_concerns(f, set, m, f->fields[i])) {
			if (n == PM_MESH_CHANGES)
				return pm_fail(PM_DATA, "more than %d change fields on mesh '%s' to carry over", PM_MESH_CHANGES, m->name);
			fields[n++] = f->fields[i];
		}
	for (int i = 0; i < n && !status; i++)
		status = plan_field(f, set, fields[i], replace);
	return status;
}

/* cell * D on the points. */
static int overlap(int status, const struct pm_frame *f, const struct pm_sets *sets, const struct pm_field *change, const struct pm_transfer *t, double *D)
{
	struct pm_transfer one = {.grid = t->grid, .kernel = t->kernel, .components = 1, .rim = t->rim, .planes = t->planes};
	status = pm_world_agree(status);
	memcpy(one.staggered[0], change->staggered[0], sizeof one.staggered[0]);
	pm_grid_even(&one.grid); /* particles have even images beyond a wall, for any field */
	for (size_t i = 0; i < sets->n && !status; i++) {
		const struct pm_field *state = pm_frame_field(f, sets->name[i], change->of);
		const struct pm_field *at = pm_frame_field(f, sets->name[i], "x");
		const double *x[3], *volume;
		struct pm_strays strays;
		bool on = false;
		if (!state || state->role != PM_STATE || !state->extensive)
			continue;
		pm_positions(f, sets->name[i], x);
		volume = pm_in(pm_frame_field(f, sets->name[i], "volume"), 0);
		status = pm_on_nodes(&one, at, &on);
		if (!status)
			status = on ? pm_on_nodes_spread(&one, at, &(struct pm_column){.doubles = volume}, false, &D)
				    : pm_spread(&one, at->count, x, &volume, &D, &strays);
	}
	return status;
}

/* The part lost at points with too few particles. */
struct thin {
	const struct pm_grid *g;
	const struct pm_planes *planes;
	const double *D, *from;
};

static void make(const void *data, size_t first, size_t end, void *part)
{
	const struct thin *t = data;
	const size_t row = pm_planes_row(t->planes, first), j = row % t->g->points[1], k = row / t->g->points[1];
	const double cell = pm_grid_cell(t->g);
	for (size_t i = first; i < end; i++)
		if (t->D[i] < 0.5)
			pm_sum_add(part, cell * pm_grid_weight(t->g, i - first, j, k) * (1 - t->D[i]) * t->from[i]);
}

static int lost(const struct pm_transfer *t, const double *D, const double *from, double *all)
{
	struct pm_sum sum = {0, 0};
	const struct pm_parts parts = {.size = sizeof sum, .make = make, .join = pm_join_sums};
	const size_t last = (size_t)t->grid.dim - 1, n = last ? t->grid.points[last] : 1;
	const struct pm_planes whole = {.points = {t->grid.points[0], t->grid.points[1], t->grid.points[2]}, .all = n, .here = n,
		.size = pm_grid_size(&t->grid) / n}, *planes = t->planes ? t->planes : &whole;
	const int status = pm_planes_over(0, planes, &parts, &(struct thin){&t->grid, planes, D, from}, &sum);
	*all = pm_sum_total(sum);
	return status;
}

static int share(struct pm_mesh_changes *c, const struct pm_frame *f, const struct pm_sets *sets, const struct pm_transfer *t)
{
	const struct pm_field *change = c->change[c->n - 1];
	size_t n = change->count;
	double *D = pm_zalloc(n + 1, sizeof *D), *to = pm_alloc(n * (size_t)change->components + 1, sizeof *to);
	int status = overlap(D && to ? 0 : pm_failed(), f, sets, change, t, D);
	c->share[c->n - 1] = to;
	for (int k = 0; k < change->components && !status; k++) {
		const double *from = pm_in(change, k);
		if (k < 3)
			status = lost(t, D, from, &c->lost[c->n - 1][k]);
#pragma omp parallel for schedule(static) if (n > 16384)
		for (size_t i = 0; i < n; i++)
			to[(size_t)k * n + i] = D[i] < 0.5 ? from[i] : from[i] / D[i];
	}
	pm_free(D);
	return status;
}

int pm_mesh_changes_init(struct pm_mesh_changes *c, const struct pm_frame *f, const struct pm_sets *sets, const struct pm_mesh *m, const struct pm_transfer *t)
{
	int status = 0;
	*c = (struct pm_mesh_changes){.n = 0};
	for (size_t i = 0; i < f->nfields && !status; i++) {
		bool any = false, strength = false;
		for (size_t k = 0; k < sets->n; k++)
			if (pm_mesh_change_concerns(f, sets->name[k], m, f->fields[i])) {
				any = true;
				strength |= pm_frame_field(f, sets->name[k], f->fields[i]->of)->extensive;
			}
		if (!any || c->n == PM_MESH_CHANGES)
			continue;
		c->change[c->n++] = f->fields[i];
		if (strength)
			status = share(c, f, sets, t);
	}
	return status;
}

void pm_mesh_changes_free(struct pm_mesh_changes *c)
{
	for (int i = 0; i < c->n; i++)
		pm_free(c->share[i]);
	c->n = 0;
}

static int append(const struct pm_frame *f, const char *set, const struct pm_field *change, const double *values, struct pm_transfer *t,
	const double *mesh[], const double *factor[], double *out[])
{
	char name[PM_NAME];
	int n = change->components;
	if (t->components + n > PM_COMPONENTS)
		return pm_fail(PM_DATA, "more than %d components to bring from '%s' to '%s' at once", PM_COMPONENTS, change->on, set);
	target_name(change, name);
	struct pm_field *to = pm_frame_field(f, set, name);
	pm_limits_add(to, pm_limits_of(change));
	for (int c = 0; c < n; c++) {
		int at = t->components++;
		mesh[at] = values ? values + (size_t)c * change->count : pm_in(change, c);
		out[at] = pm_out(to, c);
		factor[at] = values ? pm_in(pm_frame_field(f, set, "volume"), 0) : NULL;
		memcpy(t->staggered[at], change->staggered[c], sizeof t->staggered[at]);
		memset(t->flip[at], 0, sizeof t->flip[at]);
		if (n > 1 && n == f->dim)
			t->flip[at][c] = 1; /* a vector: its normal component has the image of the other sign */
	}
	return 0;
}

int pm_mesh_changes_append(const struct pm_mesh_changes *c, const struct pm_frame *f, const char *set, struct pm_transfer *t, const double *mesh[PM_COMPONENTS],
	const double *factor[PM_COMPONENTS], double *out[PM_COMPONENTS])
{
	int status = 0;
	for (int i = 0; i < c->n && !status; i++) {
		const struct pm_field *state = pm_frame_field(f, set, c->change[i]->of);
		if (state && state->role == PM_STATE)
			status = append(f, set, c->change[i], state->extensive ? c->share[i] : NULL, t, mesh, factor, out);
	}
	return status;
}
