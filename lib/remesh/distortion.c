/* Distortion: H_p = sum_j v_j zeta(x_p - x_j) and its mean relative change (1/N) sum |H - H0|/H0 since the particles were a lattice, 0 for motion
 * as a solid body. Source: Hieber and Koumoutsakos 2005, J. Comput. Phys. 210, 342; Koumoutsakos 2005, Annu. Rev. Fluid Mech. 37, 457.
 * zeta is the cubic B-spline (pcs) spread to the mesh and gathered again: a shifted lattice has H = 1 to round-off, one turned by any angle
 * to 1e-3, and it costs one p2m and one m2p where a sum over neighbours would need lists.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "remesh/distortion.h"
#include "stream/over-stretches.h"
#include "stream/parts.h"
#include "transfer/transfer.h"
#include "world/world.h"

static int overlap(int status, const struct pm_transfer *t, size_t n, const double *const x[], const double *volume, double *H)
{
	const size_t points = t->planes ? t->planes->here * t->planes->size : pm_grid_size(&t->grid);
	struct pm_strays strays;
	double *mesh = status ? NULL : pm_zalloc(points + 1, sizeof *mesh);
	status = pm_planes_agree(status ? status : mesh ? 0 : -PM_DATA, t->planes);
	status = status ? status : pm_spread(t, n, x, &volume, &mesh, &strays);
	for (size_t p = 0; p < n && !status; p++)
		H[p] = 0;
	if (!status)
		status = pm_gather(t, n, x, (const double *const *)&mesh, NULL, &H, &strays);
	pm_free(mesh);
	return status;
}

int pm_overlap(const struct pm_grid *g, const struct pm_planes *planes, size_t n, const double *const x[], const double *volume, double *H)
{
	struct pm_transfer t = {.grid = *g, .kernel = pm_kernel_find("pcs"), .components = 1, .planes = planes};
	double *cells = volume ? NULL : pm_alloc(n + 1, sizeof *cells);
	const int status = H && t.kernel && (volume || cells) ? 0 : -PM_DATA;
	for (int d = 0; d < g->dim; d++)
		for (int side = 0; side < 2 && g->face[d][0] != PM_PERIODIC; side++)
			t.grid.face[d][side] = PM_NEUMANN; /* the lattice is continued beyond a face */
	for (size_t p = 0; p < n && cells; p++)
		cells[p] = pm_grid_cell(g);
	const int done = overlap(status, &t, n, x, volume ? volume : cells, H);
	pm_free(cells);
	return done;
}

static const double *held(const struct pm_frame *f, const char *set, const char *name)
{
	const struct pm_field *field = pm_frame_field(f, set, name);
	return field && field->role == PM_STATE && (field->type == PM_F64 || field->type == PM_F32) ? pm_in(field, 0) : NULL;
}

/* The planes of this rank, if the particles are divided: those of a field of this mesh. */
static int planes_of(const struct pm_frame *f, const struct pm_mesh *m, const struct pm_grid *g, const struct pm_field *at, struct pm_planes *planes)
{
	struct pm_field nodes = {.count = pm_grid_size(g)};
	int status = at->here ? pm_field_share(&nodes, pm_division_grain(f, m->name)) : 0;
	status = status ? status : pm_planes_init(planes, g, &nodes);
	status = at->here ? pm_world_agree(status) : status;
	free((void *)(uintptr_t)nodes.from);
	return status;
}

int pm_distortion(const struct pm_frame *f, const char *set, const struct pm_mesh *m, double *distortion)
{
	const struct pm_field *at = pm_frame_field(f, set, "x");
	const double *x[3], *before = held(f, set, "overlap");
	const struct pm_grid g = pm_grid_of(f, m);
	const size_t n = at->count, all = at->here ? at->from[pm_world_size()] : n;
	struct pm_planes planes = {.from = NULL};
	struct pm_sum sum = {0, 0};
	double *H = pm_alloc(n + 1, sizeof *H);
	for (int d = 0; d < f->dim; d++)
		x[d] = pm_in(at, d);
	int status = planes_of(f, m, &g, at, &planes);
	status = status ? status : pm_overlap(&g, &planes, n, x, held(f, set, "volume"), H);
	for (size_t p = 0; p < n && !status; p++)
		H[p] = before ? fabs(H[p] - before[p]) / before[p] : fabs(H[p] - 1);
	if (!status)
		pm_sum_of_stretches(at, H, NULL, &sum);
	*distortion = all && !status ? pm_sum_total(sum) / (double)all : 0;
	pm_free(H), pm_planes_free(&planes);
	return status;
}

int pm_distortion_most(const struct pm_frame *f, const struct pm_sets *sets, const struct pm_mesh *m, double *distortion)
{
	int status = 0;
	*distortion = 0;
	for (size_t i = 0; i < sets->n && !status; i++) {
		double here;
		status = pm_distortion(f, sets->name[i], m, &here);
		*distortion = here > *distortion || isnan(here) ? here : *distortion;
	}
	return status;
}
