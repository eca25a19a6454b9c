/* Vortices in space on the nodes of a mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene-parts/scene-space.h"
#include "scene-parts/scene-vortex-set.h"
#include "scene-parts/scene-vortices.h"

int pm_scene_space(const struct pm_scene_choice *c, struct pm_frame *f, const double lo[3], const double hi[3], enum pm_face face, const size_t cells[3])
{
	return pm_scene_vortex_box(c, f, 3, lo, hi, face, cells);
}

int pm_scene_space_vorticity(struct pm_frame *f, void (*omega)(const struct pm_scene_choice *c, const double x[3], double w[3]),
	const struct pm_scene_choice *c, double least)
{
	const struct pm_mesh *m = pm_frame_mesh(f, "mesh");
	const double volume = m->h[0] * m->h[1] * m->h[2];
	size_t from[3];
	for (int d = 0; d < 3; d++)
		from[d] = f->face[d][0] == PM_PERIODIC ? 0 : PM_SCENE_MARGIN;
	double *x[3] = {NULL}, *alpha[3] = {NULL};
	size_t points[3], n = 0, first, end;
	double largest = 0, margin = 0, kept = 0;
	pm_mesh_points(f, m, points);
	pm_scene_vortex_dt(f, m);
	const size_t across = points[1] > 2 * from[1] ? points[1] - 2 * from[1] : 0, up = points[2] > 2 * from[2] ? points[2] - 2 * from[2] : 0;
	pm_scene_rows_here(across * up, &first, &end);
	for (int fill = 0; fill < 2; fill++) {
		if (fill && pm_scene_vortex_inside(c, largest, margin))
			return pm_failed();
		if (fill && pm_scene_vortex_set(f, 3, n, volume, x, alpha))
			return -PM_DATA;
		n = 0;
		for (size_t row = first; row < end; row++) {
			const size_t j = from[1] + row % across, k = from[2] + row / across;
			for (size_t i = from[0]; i + from[0] < points[0]; i++) {
				const double at[3] = {m->lo[0] + (double)i * m->h[0], m->lo[1] + (double)j * m->h[1], m->lo[2] + (double)k * m->h[2]};
				double w[3] = {0};
				omega(c, at, w);
				const double size = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
				if (!(size > least))
					continue;
				largest = fmax(largest, size);
				kept += fill ? size : 0;
				for (int d = 0; d < 3; d++) {
					const size_t node = d == 0 ? i : d == 1 ? j : k;
					margin = from[d] && (node == from[d] || node + from[d] + 1 == points[d]) ? fmax(margin, size) : margin;
				}
				for (int d = 0; d < 3 && fill; d++)
					x[d][n] = at[d], alpha[d][n] = w[d] * volume;
				n++;
			}
		}
	}
	const struct pm_scene_omega both = {.space = omega};
	const int status = pm_scene_vortex_lost(c, f, &both, least, kept, from);
	return status ? status : pm_scene_vortex_cut(f);
}
