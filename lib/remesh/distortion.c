/* Distortion: H_p = sum_j v_j zeta(x_p - x_j) and its mean relative change (1/N) sum |H - H0|/H0 since the particles were a lattice, 0 for motion
 * as a solid body. Source: Hieber and Koumoutsakos 2005, J. Comput. Phys. 210, 342; Koumoutsakos 2005, Annu. Rev. Fluid Mech. 37, 457.
 * zeta is the cubic B-spline (pcs) spread to the mesh and gathered again: a shifted lattice has H = 1 to round-off, one turned by any angle
 * to 1e-3, and it costs one p2m and one m2p where a sum over neighbours would need lists.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "remesh/distortion.h"
#include "transfer/transfer.h"

static int overlap(const struct pm_transfer *t, size_t n, const double *const x[], const double *volume, double *H)
{
	struct pm_strays strays;
	double *mesh = pm_zalloc(pm_grid_size(&t->grid), sizeof *mesh);
	int status = mesh ? pm_spread(t, n, x, &volume, &mesh, &strays) : -PM_DATA;
	for (size_t p = 0; p < n; p++)
		H[p] = 0;
	if (!status)
		status = pm_gather(t, n, x, (const double *const *)&mesh, NULL, &H, &strays);
	pm_free(mesh);
	return status;
}

int pm_overlap(const struct pm_grid *g, size_t n, const double *const x[], const double *volume, double *H)
{
	struct pm_transfer t = {.grid = *g, .kernel = pm_kernel_find("pcs"), .components = 1};
	double *cells = volume ? NULL : pm_alloc(n, sizeof *cells);
	if (!t.kernel || (!volume && !cells))
		return -PM_DATA;
	for (int d = 0; d < g->dim; d++)
		for (int side = 0; side < 2 && g->face[d][0] != PM_PERIODIC; side++)
			t.grid.face[d][side] = PM_NEUMANN; /* the lattice is continued beyond a face */
	for (size_t p = 0; p < n && cells; p++)
		cells[p] = pm_grid_cell(g);
	int status = overlap(&t, n, x, volume ? volume : cells, H);
	pm_free(cells);
	return status;
}

static const double *held(const struct pm_frame *f, const char *set, const char *name)
{
	const struct pm_field *field = pm_frame_field(f, set, name);
	return field && field->role == PM_STATE && (field->type == PM_F64 || field->type == PM_F32) ? pm_in(field, 0) : NULL;
}

int pm_distortion(const struct pm_frame *f, const char *set, const struct pm_mesh *m, double *distortion)
{
	const struct pm_field *at = pm_frame_field(f, set, "x");
	const double *x[3], *before = held(f, set, "overlap");
	const struct pm_grid g = pm_grid_of(f, m);
	size_t n = at->count;
	double *H = pm_alloc(n, sizeof *H);
	for (int d = 0; d < f->dim; d++)
		x[d] = pm_in(at, d);
	int status = H ? pm_overlap(&g, n, x, held(f, set, "volume"), H) : -PM_DATA;
	for (size_t p = 0; p < n && !status; p++)
		H[p] = before ? fabs(H[p] - before[p]) / before[p] : fabs(H[p] - 1);
	*distortion = n && !status ? pm_sum_array(n, H) / (double)n : 0;
	pm_free(H);
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
