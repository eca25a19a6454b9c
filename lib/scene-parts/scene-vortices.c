/* Vortices in the plane: points, or a lattice on the nodes of the mesh that represents a vorticity.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "scene-parts/scene-vortices.h"
#include "stream/declare.h"

int pm_scene_plane(const struct pm_scene_choice *c, struct pm_frame *f, double lo, double hi, enum pm_face face, size_t cells)
{
	size_t n[3] = {cells, cells, 1};
	snprintf(f->law, sizeof f->law, "vortex");
	for (int d = 0; d < 2; d++) {
		f->lo[d] = lo, f->hi[d] = hi;
		n[d] = c->cells[d] ? c->cells[d] : cells;
		for (int side = 0; side < 2; side++) {
			f->face[d][side] = face;
			f->pface[d][side] = face == PM_PERIODIC ? PM_PFOLD : PM_POPEN;
		}
	}
	return pm_frame_mesh_new(f, "mesh", n) ? 0 : -PM_DATA;
}

int pm_scene_vortices(struct pm_frame *f, uint64_t n, double volume, struct pm_scene_vortices *v)
{
	const char *on = "vortices";
	struct pm_set *set = pm_frame_set_new(f, on, n);
	struct pm_field *x = set ? pm_makes(f, on, "x", 2, PM_STATE) : NULL;
	struct pm_field *q = x ? pm_makes(f, on, "circulation", 1, PM_STATE) : NULL;
	struct pm_field *w = q ? pm_makes(f, on, "volume", 1, PM_STATE) : NULL;
	struct pm_field *id = w ? pm_makes(f, on, "id", 1, PM_STATE) : NULL;
	if (!id)
		return -PM_DATA;
	snprintf(x->unit, sizeof x->unit, "length");
	snprintf(q->unit, sizeof q->unit, "length^2/time");
	snprintf(w->unit, sizeof w->unit, "length^2");
	q->extensive = w->extensive = true;
	w->uniform = true;
	w->value[0] = volume;
	id->type = PM_I64;
	if (pm_field_ready(x) || pm_field_ready(q) || pm_field_ready(id))
		return -PM_DATA;
	*v = (struct pm_scene_vortices){.x = {pm_out(x, 0), pm_out(x, 1)}, .circulation = pm_out(q, 0)};
	for (uint64_t i = 0; i < n; i++)
		pm_out_i64(id, 0)[i] = (int64_t)i;
	return 0;
}

/* Explicit diffusion with differences of order 6 decays at up to 272/45 nu (1/hx^2 + 1/hy^2); lsrk3 is stable to 2.5127 of that, 0.986 of it is taken. */
static double stable(const struct pm_frame *f, const struct pm_mesh *m)
{
	const double nu = pm_frame_constant(f, "nu", 0);
	return nu > 0 ? 0.986 * 2.5127 * 45 / 272 / (nu * (1 / (m->h[0] * m->h[0]) + 1 / (m->h[1] * m->h[1]))) : HUGE_VAL;
}

int pm_scene_vorticity(struct pm_frame *f, double (*omega)(const struct pm_scene_choice *c, double x, double y),
	const struct pm_scene_choice *c, double least)
{
	const struct pm_mesh *m = pm_frame_mesh(f, "mesh");
	struct pm_scene_vortices v = {0};
	size_t points[3], n = 0;
	pm_mesh_points(f, m, points);
	f->dt = fmin(f->dt, stable(f, m));
	for (int fill = 0; fill < 2; fill++) {
		if (fill && pm_scene_vortices(f, n, m->h[0] * m->h[1], &v))
			return -PM_DATA;
		const size_t from = f->face[0][0] == PM_PERIODIC ? 0 : PM_SCENE_MARGIN;
		n = 0;
		for (size_t j = from; j + from < points[1]; j++)
			for (size_t i = from; i + from < points[0]; i++) {
				const double x = m->lo[0] + (double)i * m->h[0], y = m->lo[1] + (double)j * m->h[1], w = omega(c, x, y);
				if (!(fabs(w) > least))
					continue;
				if (fill)
					v.x[0][n] = x, v.x[1][n] = y, v.circulation[n] = w * (m->h[0] * m->h[1]);
				n++;
			}
	}
	return 0;
}
