/* Known values on faces for the symbols of higher order: for each axis and kind of face a harmonic function with these values (fft-fitted.c), added to the
 * solution without them.
 * Assumes: the values are smooth in the modes of the other axes: where walls meet they vanish. Cost: a solve for each axis and kind of face.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-fft/fft-boundary.h"
#include "world/world.h"

int pm_poisson_fft_boundary_check(const struct pm_grid *g, const struct pm_poisson_fft_choice *o)
{
	if ((o->green && !o->green->differences) || pm_influence_any(&o->influence))
		return pm_fail(PM_USAGE, "boundary values belong to the Laplacian or its differences (leave out --green, --influence and --cloud)");
	for (int a = 0; a < 2 * g->dim; a++)
		if (o->symbol != PM_FD2 && g->face[a / 2][a % 2] == PM_OPEN)
			return pm_fail(PM_DATA, "boundary values beside open faces need the differences of order 2 (leave --symbol out)");
	return 0;
}

/* The faces of axis d that are of this kind and have values, as bits 2 d + side. */
static unsigned faces_of(const struct pm_boundary *b, int d, bool neumann)
{
	unsigned faces = 0;
	for (int side = 0; side < 2; side++)
		if (b->value[d][side] && b->grid.face[d][side] == (neumann ? PM_NEUMANN : PM_WALL))
			faces |= 1u << (2 * d + side);
	return faces;
}

static size_t points_here(const struct pm_boundary *b) { return b->planes ? b->planes->here * b->planes->size : pm_grid_size(&b->grid); }

static int add(struct pm_fft_solvers *s, const struct pm_poisson_fft_choice *o, const struct pm_boundary *b, unsigned faces, double *known, double *u,
	double *phi)
{
	struct pm_poisson_fft *solver = pm_fft_solvers_find(s, &b->grid, o);
	struct pm_poisson_fft_record r;
	int status = 0;
	if (!solver && !(solver = pm_fft_solvers_add(s, &b->grid, o, false)))
		status = -PM_DATA;
	status = pm_world_agree(status);
	if (!status)
		pm_boundary_known(b, 2, faces, NULL, known);
	if (!status)
		status = pm_poisson_fft_solve(solver, -1, known, u, &r);
	for (size_t i = 0; i < points_here(b) && !status; i++)
		phi[i] += u[i];
	return status;
}

/* The largest value on an edge where two walls meet, over the largest on all walls. */
static double on_edges(const struct pm_boundary *b)
{
	const struct pm_grid *g = &b->grid;
	double edge = 0, all = 0;
	for (int a = 0; a < 2 * g->dim; a++) {
		const int d = a / 2, t[2] = {d == 0, d == 2 ? 1 : 2};
		const double *v = g->face[d][a % 2] == PM_WALL ? b->value[d][a % 2] : NULL;
		for (size_t i = 0; v && i < pm_boundary_points(g, d); i++) {
			const size_t at[2] = {i % g->points[t[0]], i / g->points[t[0]]};
			all = fmax(all, fabs(v[i]));
			for (int k = 0; k < 2; k++)
				if (t[k] < g->dim && ((at[k] == 0 && g->face[t[k]][0] == PM_WALL) || (at[k] == g->cells[t[k]] && g->face[t[k]][1] == PM_WALL)))
					edge = fmax(edge, fabs(v[i]));
		}
	}
	return all > 0 ? edge / all : 0;
}

int pm_poisson_fft_boundary(struct pm_fft_solvers *s, const struct pm_poisson_fft_choice *o, const struct pm_boundary *b, double *phi)
{
	const size_t n = points_here(b) + 1;
	double *known = pm_alloc(n, sizeof *known), *u = pm_alloc(n, sizeof *u);
	const double edges = on_edges(b);
	int status = pm_world_agree(known && u ? 0 : -PM_DATA);
	if (!status && edges > 1e-6)
		status = pm_fail(PM_DATA, "the boundary values are %.2g of the largest where walls meet, and there the series of --symbol spectral, fd4 and "
			"fd6 do not converge (leave --symbol out, or poisson-mg --order 4)", edges);
	for (int d = 0; d < 2 * b->grid.dim && !status; d++) {
		struct pm_poisson_fft_choice one = *o;
		unsigned faces = faces_of(b, d / 2, d % 2);
		one.fitted = 1 + d;
		if (faces)
			status = add(s, &one, b, faces, known, u, phi);
	}
	pm_free(known), pm_free(u);
	return status;
}
