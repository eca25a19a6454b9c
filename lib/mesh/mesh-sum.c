/* Sums over a mesh, and over what a field is on. SPDX-License-Identifier: GPL-3.0-or-later */
#include "mesh/mesh-sum.h"
#include "mesh/planes.h"
#include "stream/over-stretches.h"

/* Weights of quadrature at the ends of each axis. */
static void ends(const struct pm_grid *g, double end[3][2])
{
	for (int d = 0; d < 3; d++)
		end[d][0] = end[d][1] = g->points[d] > g->cells[d] ? 0.5 : 1;
}

double pm_grid_sum(const struct pm_grid *g, const double *x, const double *y)
{
	double end[3][2];
	struct pm_sum all = {0, 0};
	ends(g, end);
	pm_sum_of_mesh(g->points, x, y, (const double(*)[2])end, &all);
	return pm_sum_total(all);
}

double pm_grid_sum_of(const struct pm_grid *g, const struct pm_field *field, const double *x, const double *y)
{
	struct pm_planes planes;
	struct pm_sum all = {0, 0};
	double end[3][2];
	if (!field->here)
		return pm_grid_sum(g, x, y);
	ends(g, end);
	if (pm_planes_sum(pm_planes_init(&planes, g, field), &planes, x, y, (const double(*)[2])end, &all)) /* all ranks know of a failure */
		pm_cannot_go_on();
	pm_planes_free(&planes);
	return pm_sum_total(all);
}

void pm_grid_over(const struct pm_grid *g, const struct pm_field *field, const struct pm_parts *p, const void *data, void *all)
{
	struct pm_planes planes;
	if (!field->here) {
		pm_over_mesh(p, data, g->points, all);
		return;
	}
	if (pm_planes_over(pm_planes_init(&planes, g, field), &planes, p, data, all))
		pm_cannot_go_on();
	pm_planes_free(&planes);
}

size_t pm_grid_rows_before(const struct pm_grid *g, const struct pm_field *field) { return field->here ? (size_t)field->first / g->points[0] : 0; }

void pm_over_field(const struct pm_parts *p, const void *data, const struct pm_frame *f, const struct pm_field *field, void *all)
{
	const struct pm_mesh *m = pm_frame_mesh(f, field->on);
	if (!m) {
		pm_over_stretches(field, p, data, all);
		return;
	}
	const struct pm_grid g = pm_grid_of(f, m);
	pm_grid_over(&g, field, p, data, all);
}
