/* Particles on the nodes of the periodic unit square that carry the scene's level. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "scene-parts/scene-level.h"
#include "stream/declare.h"

static int plane(const struct pm_scene_choice *c, struct pm_frame *f, size_t cells)
{
	size_t n[3] = {1, 1, 1};
	snprintf(f->law, sizeof f->law, "passive");
	for (int d = 0; d < f->dim; d++) {
		f->lo[d] = 0, f->hi[d] = 1;
		n[d] = c->cells[d] ? c->cells[d] : cells;
		for (int side = 0; side < 2; side++)
			f->face[d][side] = PM_PERIODIC, f->pface[d][side] = PM_PFOLD;
	}
	return pm_frame_mesh_new(f, "mesh", n) ? 0 : -PM_DATA;
}

int pm_scene_level(const struct pm_scene_choice *c, struct pm_frame *f, size_t cells, double (*level)(const struct pm_frame *f, const double x[], double t))
{
	if (plane(c, f, cells))
		return -PM_DATA;
	const char *on = "matter";
	const struct pm_mesh *m = pm_frame_mesh(f, "mesh");
	size_t points[3];
	pm_mesh_points(f, m, points);
	struct pm_set *set = pm_frame_set_new(f, on, (uint64_t)points[0] * points[1]);
	struct pm_field *at = set ? pm_makes(f, on, "x", f->dim, PM_STATE) : NULL;
	struct pm_field *volume = at ? pm_makes(f, on, "volume", 1, PM_STATE) : NULL;
	struct pm_field *value = volume ? pm_makes(f, on, "level", 1, PM_STATE) : NULL;
	if (!value)
		return -PM_DATA;
	snprintf(at->unit, sizeof at->unit, "length");
	snprintf(volume->unit, sizeof volume->unit, "length^%d", f->dim);
	snprintf(value->unit, sizeof value->unit, "length");
	volume->extensive = volume->uniform = true;
	volume->value[0] = m->h[0] * m->h[1];
	if (pm_field_ready(at) || pm_field_ready(value))
		return -PM_DATA;
	for (size_t j = 0, i = 0; j < points[1]; j++)
		for (size_t k = 0; k < points[0]; k++, i++) {
			const double x[2] = {m->lo[0] + (double)k * m->h[0], m->lo[1] + (double)j * m->h[1]};
			for (int d = 0; d < 2; d++)
				pm_out(at, d)[i] = x[d];
			pm_out(value, 0)[i] = level(f, x, 0);
		}
	return 0;
}
