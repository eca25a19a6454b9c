/* The box, the mesh and the set of bodies of most scenes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "scene-parts/scene-bodies.h"
#include "stream/declare.h"
#include "stream/parts.h"
#include "world/over-ranks.h"

void pm_scene_world(struct pm_frame *f, double lo, double hi, enum pm_face face, double softening, double dt)
{
	snprintf(f->law, sizeof f->law, "gravity");
	pm_frame_constant_set(f, "G", 1);
	pm_frame_constant_set(f, "softening", softening);
	for (int d = 0; d < f->dim; d++) {
		f->lo[d] = lo, f->hi[d] = hi;
		for (int side = 0; side < 2; side++) {
			f->face[d][side] = face;
			f->pface[d][side] = face == PM_PERIODIC ? PM_PFOLD : PM_POPEN;
		}
	}
	f->dt = dt;
}

int pm_scene_mesh(struct pm_frame *f, size_t cells)
{
	const size_t c[3] = {cells, f->dim > 1 ? cells : 1, f->dim > 2 ? cells : 1};
	return pm_frame_mesh_new(f, "mesh", c) ? 0 : -PM_DATA;
}

static int ready(struct pm_field *p)
{
	const int status = pm_world_size() > 1 ? pm_field_share(p, pm_sum_block) : 0;
	return status ? status : pm_field_ready(p);
}

int pm_scene_set(struct pm_frame *f, const char *name, uint64_t n, bool moves, double mass, struct pm_scene_body *b)
{
	struct pm_set *set = pm_frame_set_new(f, name, n);
	struct pm_field *x = set ? pm_makes(f, name, "x", f->dim, PM_STATE) : NULL;
	struct pm_field *v = x && moves ? pm_makes(f, name, "v", f->dim, PM_STATE) : NULL;
	struct pm_field *m = x && (v || !moves) ? pm_makes(f, name, "mass", 1, PM_STATE) : NULL;
	struct pm_field *id = m ? pm_makes(f, name, "id", 1, PM_STATE) : NULL;
	if (!id)
		return -PM_DATA;
	set->fixed = !moves;
	snprintf(x->unit, sizeof x->unit, "length");
	snprintf(m->unit, sizeof m->unit, "mass");
	m->extensive = true;
	id->type = PM_I64;
	m->uniform = !isnan(mass);
	m->value[0] = m->uniform ? mass : 0;
	if (pm_world_agree(ready(x) || ready(id) || (v && ready(v)) || (!m->uniform && ready(m)) ? pm_failed() : 0))
		return -PM_DATA;
	*b = (struct pm_scene_body){.here = x->count, .first = x->first, .mass = m->uniform ? NULL : pm_out(m, 0), .id = pm_out_i64(id, 0)};
	for (int d = 0; d < f->dim; d++) {
		b->x[d] = pm_out(x, d);
		b->v[d] = v ? pm_out(v, d) : NULL;
	}
	if (v)
		snprintf(v->unit, sizeof v->unit, "length/time");
	for (uint64_t i = 0; i < b->here; i++)
		b->id[i] = (int64_t)(b->first + i);
	return 0;
}

static double sum(uint64_t n, const double *x, const double *y)
{
	struct pm_sum all = {0};
	if (pm_world_sum_of_set(0, n, x, y, &all))
		pm_cannot_go_on();
	return pm_sum_total(all);
}

void pm_scene_centre(uint64_t n, const double *weight, double *a)
{
	int64_t all = (int64_t)n;
	if (pm_world_count(0, PM_SUM_OF, 1, &all))
		pm_cannot_go_on();
	if (!all)
		return;
	const double total = weight ? sum(n, weight, NULL) : (double)all;
	for (int pass = 0; pass < 2; pass++) {
		const double mean = (weight ? sum(n, weight, a) : sum(n, a, NULL)) / total;
#pragma omp parallel for schedule(static)
		for (uint64_t i = 0; i < n; i++)
			a[i] -= mean;
	}
}

size_t pm_scene_per_axis(uint64_t n, int dim)
{
	const uint64_t side = (uint64_t)llround(pow((double)n, 1.0 / dim));
	uint64_t full = 1, below = 1, above = 1;
	for (int d = 0; d < dim; d++)
		full *= side;
	if (full == n && n)
		return side;
	const uint64_t low = full > n ? side - 1 : side;
	for (int d = 0; d < dim; d++)
		below *= low, above *= low + 1;
	pm_fail(PM_USAGE, "%llu particles do not fill a lattice in %d-D (take -n %llu or %llu)", (unsigned long long)n, dim,
		(unsigned long long)below, (unsigned long long)above);
	return 0;
}
