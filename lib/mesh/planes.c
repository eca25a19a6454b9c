/* The planes of a mesh on a rank: their number, those of the neighbours, and parts over all. Cost: a copy of the planes here, and what travels: 2 wide planes
 * a rank and component; a part per plane (in 2-D per row). SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "mesh/planes.h"
#include "world/over-ranks.h"

int pm_planes_init(struct pm_planes *p, const struct pm_grid *g, const struct pm_field *field)
{
	const int axis = g->dim - 1;
	*p = (struct pm_planes){.points = {g->points[0], g->points[1], g->points[2]}, .axis = axis, .all = axis ? g->points[axis] : 1,
		.periodic = axis && g->face[axis][0] == PM_PERIODIC, .divided = field->here};
	p->size = pm_grid_size(g) / p->all;
	p->here = p->all;
	if (!p->divided)
		return 0;
	const size_t ranks = (size_t)pm_world_size();
	if (!(p->from = malloc((ranks + 1) * sizeof *p->from)))
		return pm_no_memory();
	for (size_t r = 0; r <= ranks; r++)
		p->from[r] = field->from[r] / p->size;
	p->first = field->first / p->size;
	p->here = field->count / p->size;
	return 0;
}

int pm_planes_copy(struct pm_planes *p, const struct pm_grid *g, const struct pm_planes *from)
{
	if (!from || !from->divided)
		return pm_planes_init(p, g, &(struct pm_field){.here = false});
	const size_t bytes = ((size_t)pm_world_size() + 1) * sizeof *p->from;
	*p = *from;
	if (!(p->from = malloc(bytes)))
		return pm_no_memory();
	memcpy(p->from, from->from, bytes);
	return 0;
}

int pm_planes_agree(int status, const struct pm_planes *p) { return p && p->divided ? pm_world_agree(status) : status; }

void pm_planes_free(struct pm_planes *p)
{
	free(p->from);
	p->from = NULL;
}

int pm_planes_halo(int status, const struct pm_planes *p, int wide, int n, const double *const in[], const double *with[], double **room)
{
	const size_t each = (p->here + 2 * (size_t)wide) * p->size, below = (size_t)wide * p->size;
	*room = status ? NULL : pm_alloc(each * (size_t)n + 1, sizeof **room);
	status = status ? status : *room ? 0 : pm_failed();
	for (int c = 0; c < n; c++) {
		double *own = *room ? *room + each * (size_t)c + below : NULL;
		const struct pm_halo halo = {.from = p->from, .bytes = p->size * sizeof *own, .wide = wide, .periodic = p->periodic};
		if (own) {
			memset(own - below, 0, below * sizeof *own);
			memcpy(own, in[c], p->here * p->size * sizeof *own);
			memset(own + p->here * p->size, 0, below * sizeof *own);
		}
		with[c] = own;
		status = pm_world_halo(status, &halo, own);
	}
	return status;
}

int pm_planes_over(int status, const struct pm_planes *p, const struct pm_parts *parts, const void *data, void *all)
{
	const size_t rows = p->axis == 2 && p->points[2] == 1 ? p->points[1] : 1; /* a mesh of one plane is joined by rows, as in 2-D */
	if (p->divided)
		return pm_world_over_mesh(status, parts, data, p->points, p->here * rows, all);
	if (!status)
		pm_over_mesh(parts, data, p->points, all);
	return status;
}

int pm_planes_sum(int status, const struct pm_planes *p, const double *x, const double *y, const double end[3][2], struct pm_sum *all)
{
	return pm_planes_over(status, p, &pm_mesh_sums, &(struct pm_mesh_values){x, y, p->points, end, pm_planes_row(p, 0)}, all);
}
