/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "scene-parts/scene-vortex-set.h"
#include "stream/declare.h"

int pm_scene_vortex_box(const struct pm_scene_choice *c, struct pm_frame *f, int dim, const double lo[3], const double hi[3], enum pm_face face,
	const size_t cells[3])
{
	size_t n[3] = {1, 1, 1};
	snprintf(f->law, sizeof f->law, "vortex");
	for (int d = 0; d < dim; d++) {
		f->lo[d] = lo[d], f->hi[d] = hi[d];
		n[d] = c->cells[d] ? c->cells[d] : cells[d];
		for (int side = 0; side < 2; side++) {
			f->face[d][side] = face;
			f->pface[d][side] = face == PM_PERIODIC ? PM_PFOLD : PM_POPEN;
		}
	}
	return pm_frame_mesh_new(f, "mesh", n) ? 0 : -PM_DATA;
}

int pm_scene_vortex_set(struct pm_frame *f, int dim, uint64_t n, double volume, double *x[], double *strength[])
{
	const char *on = "vortices";
	const int components = dim == 2 ? 1 : 3;
	struct pm_set *set = pm_frame_set_new(f, on, n);
	struct pm_field *at = set ? pm_makes(f, on, "x", dim, PM_STATE) : NULL;
	struct pm_field *q = at ? pm_makes(f, on, dim == 2 ? "circulation" : "alpha", components, PM_STATE) : NULL;
	struct pm_field *w = q ? pm_makes(f, on, "volume", 1, PM_STATE) : NULL;
	struct pm_field *id = w ? pm_makes(f, on, "id", 1, PM_STATE) : NULL;
	if (!id)
		return -PM_DATA;
	snprintf(at->unit, sizeof at->unit, "length");
	snprintf(q->unit, sizeof q->unit, "length^%d/time", dim);
	snprintf(w->unit, sizeof w->unit, "length^%d", dim);
	q->extensive = w->extensive = true;
	w->uniform = true;
	w->value[0] = volume;
	id->type = PM_I64;
	if (pm_field_ready(at) || pm_field_ready(q) || pm_field_ready(id))
		return -PM_DATA;
	for (int d = 0; d < dim; d++)
		x[d] = pm_out(at, d);
	for (int d = 0; d < components; d++)
		strength[d] = pm_out(q, d);
	for (uint64_t i = 0; i < n; i++)
		pm_out_i64(id, 0)[i] = (int64_t)i;
	return 0;
}

void pm_scene_vortex_dt(struct pm_frame *f, const struct pm_mesh *m)
{
	const double nu = pm_frame_constant(f, "nu", 0);
	double sum = 0;
	for (int d = 0; d < f->dim; d++)
		sum += 1 / (m->h[d] * m->h[d]);
	if (nu > 0)
		f->dt = fmin(f->dt, 0.986 * 2.5127 * 45 / 272 / (nu * sum));
}
