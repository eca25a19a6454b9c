/* The law, box, mesh and fields of electromagnetic scenes. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "law/law.h"
#include "scene-parts/scene-electromagnetic.h"
#include "stream/declare.h"

int pm_scene_em_world(const struct pm_scene_choice *c, struct pm_frame *f, double length, size_t cells, double background)
{
	size_t n[3] = {1, 1, 1};
	double least = length;
	pm_scene_plasma_world(f, length, background, 0);
	snprintf(f->law, sizeof f->law, "electromagnetic");
	pm_frame_constant_set(f, "c", 1);
	for (int d = 0; d < f->dim; d++) {
		n[d] = c->cells[0] ? c->cells[d] : cells;
		least = fmin(least, length / (double)n[d]);
	}
	f->dt = 0.5 * least;
	return pm_frame_mesh_new(f, "mesh", n) ? 0 : -PM_DATA;
}

static int fill(struct pm_frame *f, const char *name, bool electric, double (*value)(int c, const double x[3], const void *data), const void *data)
{
	const struct pm_mesh *m = pm_frame_mesh(f, "mesh");
	struct pm_field *field = pm_makes(f, "mesh", name, 3, PM_STATE);
	if (!field)
		return -PM_DATA;
	for (int c = 0; c < 3; c++)
		for (int d = 0; d < f->dim; d++)
			field->staggered[c][d] = (c == d) == electric;
	if (pm_field_ready(field))
		return -PM_DATA;
	const struct pm_grid g = pm_grid_of(f, m);
	for (int c = 0; c < 3 && value; c++)
		for (size_t p = 0; p < pm_grid_size(&g); p++) {
			const size_t at[3] = {p % g.points[0], p / g.points[0] % g.points[1], p / g.points[0] / g.points[1]};
			double x[3] = {0};
			bool inside = true; /* what would sit half a cell beyond the last face stays 0 */
			for (int d = 0; d < f->dim; d++) {
				inside &= !field->staggered[c][d] || at[d] < g.cells[d];
				x[d] = g.lo[d] + ((double)at[d] + 0.5 * field->staggered[c][d]) * g.h[d];
			}
			pm_out(field, c)[p] = inside ? value(c, x, data) : 0;
		}
	return 0;
}

int pm_scene_em_fields(struct pm_frame *f, double (*electric)(int c, const double x[3], const void *data),
	double (*magnetic)(int c, const double x[3], const void *data), const void *data)
{
	int status = fill(f, "E", true, electric, data);
	return status ? status : fill(f, "B", false, magnetic, data);
}

void pm_scene_em_polarisation(int axes, double across[3], double third[3])
{
	static const double along[4][3] = {{0}, {1, 0, 0}, {0.70710678118654752, 0.70710678118654752, 0},
		{0.57735026918962576, 0.57735026918962576, 0.57735026918962576}};
	const double *k = along[axes], plane = hypot(k[0], k[1]);
	across[0] = -k[1] / plane, across[1] = k[0] / plane, across[2] = 0;
	for (int d = 0; d < 3; d++)
		third[d] = k[(d + 1) % 3] * across[(d + 2) % 3] - k[(d + 2) % 3] * across[(d + 1) % 3];
}
