/* Vortices in space on the nodes of a mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "scene-parts/scene-space.h"
#include "scene-parts/scene-vortices.h"
#include "stream/declare.h"

int pm_scene_space(const struct pm_scene_choice *c, struct pm_frame *f, const double lo[3], const double hi[3], enum pm_face face, const size_t cells[3])
{
	size_t n[3];
	snprintf(f->law, sizeof f->law, "vortex");
	for (int d = 0; d < 3; d++) {
		f->lo[d] = lo[d], f->hi[d] = hi[d];
		n[d] = c->cells[d] ? c->cells[d] : cells[d];
		for (int side = 0; side < 2; side++) {
			f->face[d][side] = face;
			f->pface[d][side] = face == PM_PERIODIC ? PM_PFOLD : PM_POPEN;
		}
	}
	return pm_frame_mesh_new(f, "mesh", n) ? 0 : -PM_DATA;
}

/* The fields of the set; the data of x and alpha. */
static int set_of(struct pm_frame *f, uint64_t n, double volume, double *x[3], double *alpha[3])
{
	const char *on = "vortices";
	struct pm_set *set = pm_frame_set_new(f, on, n);
	struct pm_field *at = set ? pm_makes(f, on, "x", 3, PM_STATE) : NULL;
	struct pm_field *q = at ? pm_makes(f, on, "alpha", 3, PM_STATE) : NULL;
	struct pm_field *w = q ? pm_makes(f, on, "volume", 1, PM_STATE) : NULL;
	struct pm_field *id = w ? pm_makes(f, on, "id", 1, PM_STATE) : NULL;
	if (!id)
		return -PM_DATA;
	snprintf(at->unit, sizeof at->unit, "length");
	snprintf(q->unit, sizeof q->unit, "length^3/time");
	snprintf(w->unit, sizeof w->unit, "length^3");
	q->extensive = w->extensive = true;
	w->uniform = true;
	w->value[0] = volume;
	id->type = PM_I64;
	if (pm_field_ready(at) || pm_field_ready(q) || pm_field_ready(id))
		return -PM_DATA;
	for (int d = 0; d < 3; d++)
		x[d] = pm_out(at, d), alpha[d] = pm_out(q, d);
	for (uint64_t i = 0; i < n; i++)
		pm_out_i64(id, 0)[i] = (int64_t)i;
	return 0;
}

/* As in the plane (scene-vortices.c): 0.986 of lsrk3's limit with differences of order 6. */
static double stable(const struct pm_frame *f, const struct pm_mesh *m)
{
	const double nu = pm_frame_constant(f, "nu", 0);
	double sum = 0;
	for (int d = 0; d < 3; d++)
		sum += 1 / (m->h[d] * m->h[d]);
	return nu > 0 ? 0.986 * 2.5127 * 45 / 272 / (nu * sum) : HUGE_VAL;
}

int pm_scene_space_vorticity(struct pm_frame *f, void (*omega)(const struct pm_scene_choice *c, const double x[3], double w[3]),
	const struct pm_scene_choice *c, double least)
{
	const struct pm_mesh *m = pm_frame_mesh(f, "mesh");
	const double volume = m->h[0] * m->h[1] * m->h[2];
	const size_t from = f->face[0][0] == PM_PERIODIC ? 0 : PM_SCENE_MARGIN;
	double *x[3] = {NULL}, *alpha[3] = {NULL};
	size_t points[3], n = 0;
	pm_mesh_points(f, m, points);
	f->dt = fmin(f->dt, stable(f, m));
	for (int fill = 0; fill < 2; fill++) {
		if (fill && set_of(f, n, volume, x, alpha))
			return -PM_DATA;
		n = 0;
		for (size_t k = from; k + from < points[2]; k++)
			for (size_t j = from; j + from < points[1]; j++)
				for (size_t i = from; i + from < points[0]; i++) {
					const double at[3] = {m->lo[0] + (double)i * m->h[0], m->lo[1] + (double)j * m->h[1], m->lo[2] + (double)k * m->h[2]};
					double w[3] = {0};
					omega(c, at, w);
					if (!(sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) > least))
						continue;
					for (int d = 0; d < 3 && fill; d++)
						x[d][n] = at[d], alpha[d][n] = w[d] * volume;
					n++;
				}
	}
	return 0;
}
