/* Vortices in the plane: points, or a lattice on the nodes of the mesh that represents a vorticity.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene-parts/scene-vortex-set.h"
#include "scene-parts/scene-vortices.h"

int pm_scene_plane(const struct pm_scene_choice *c, struct pm_frame *f, double lo, double hi, enum pm_face face, size_t cells)
{
	return pm_scene_vortex_box(c, f, 2, (const double[]){lo, lo, 0}, (const double[]){hi, hi, 0}, face, (const size_t[]){cells, cells, 1});
}

int pm_scene_vortices(struct pm_frame *f, uint64_t n, double volume, struct pm_scene_vortices *v)
{
	return pm_scene_vortex_set(f, 2, n, volume, v->x, &v->circulation);
}

int pm_scene_vorticity(struct pm_frame *f, double (*omega)(const struct pm_scene_choice *c, double x, double y),
	const struct pm_scene_choice *c, double least)
{
	const struct pm_mesh *m = pm_frame_mesh(f, "mesh");
	struct pm_scene_vortices v = {0};
	size_t points[3], n = 0, first, end;
	double largest = 0, margin = 0, kept = 0;
	pm_mesh_points(f, m, points);
	pm_scene_vortex_dt(f, m);
	const size_t from = f->face[0][0] == PM_PERIODIC ? 0 : PM_SCENE_MARGIN;
	pm_scene_rows_here(points[1] > 2 * from ? points[1] - 2 * from : 0, &first, &end);
	for (int fill = 0; fill < 2; fill++) {
		if (fill && from && pm_scene_vortex_inside(c, largest, margin))
			return pm_failed();
		if (fill && pm_scene_vortices(f, n, m->h[0] * m->h[1], &v))
			return -PM_DATA;
		n = 0;
		for (size_t j = from + first; j < from + end; j++)
			for (size_t i = from; i + from < points[0]; i++) {
				const double x = m->lo[0] + (double)i * m->h[0], y = m->lo[1] + (double)j * m->h[1], w = omega(c, x, y);
				if (!(fabs(w) > least))
					continue;
				largest = fmax(largest, fabs(w));
				kept += fill ? fabs(w) : 0;
				if (j == from || i == from || j + from + 1 == points[1] || i + from + 1 == points[0])
					margin = fmax(margin, fabs(w));
				if (fill)
					v.x[0][n] = x, v.x[1][n] = y, v.circulation[n] = w * (m->h[0] * m->h[1]);
				n++;
			}
	}
	const struct pm_scene_omega both = {.plane = omega};
	const int status = pm_scene_vortex_lost(c, f, &both, least, kept, (const size_t[3]){from, from, 0});
	return status ? status : pm_scene_vortex_cut(f);
}
