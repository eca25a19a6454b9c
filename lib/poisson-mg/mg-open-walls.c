/* James' method between two solutions in a box with walls:
 *   q = A u - f on the walls of the grounded box;  phi = -G * q on them (mg-open-faces.c);  f -= A of these values
 * Ranks that share the mesh compute the charge on the walls in their planes, of which a surface has N^2 numbers and all get all, as the values.
 * Source: James 1977. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-open-parts.h"
#include "world/world.h"

struct mg_walls {
	struct pm_grid grid, walled;
	struct mg_stencil stencil;
	int order;
	struct pm_planes planes;
	struct mg_faces *faces;
	struct pm_boundary charge, wall;
};

struct pm_grid pm_mg_walled(const struct pm_grid *g)
{
	struct pm_grid walled = *g;
	for (int d = 0; d < g->dim; d++)
		walled.face[d][0] = walled.face[d][1] = PM_WALL;
	return walled;
}

const struct pm_planes *pm_mg_walls_planes(const struct mg_walls *o) { return &o->planes; }

struct mg_walls *pm_mg_walls_free(struct mg_walls *o)
{
	if (o) {
		pm_mg_faces_free(o->faces);
		pm_boundary_free(&o->charge), pm_boundary_free(&o->wall);
		pm_planes_free(&o->planes);
	}
	return pm_free(o);
}

static int build(struct mg_walls *o, const struct pm_grid *g, int order, const struct pm_planes *planes)
{
	o->grid = *g;
	o->walled = pm_mg_walled(g);
	o->order = order;
	o->stencil = pm_mg_stencil(g, order);
	o->charge.grid = o->wall.grid = o->walled;
	o->charge.planes = o->wall.planes = &o->planes;
	int status = pm_planes_copy(&o->planes, g, planes);
	for (int a = 0; a < 2 * g->dim && !status; a++)
		status = pm_boundary_room(&o->charge, a / 2, a % 2) || pm_boundary_room(&o->wall, a / 2, a % 2) ? -PM_DATA : 0;
	return status;
}

struct mg_walls *pm_mg_walls_new(const struct pm_grid *g, int order, const struct pm_planes *planes)
{
	struct mg_walls *o = pm_zalloc(1, sizeof *o);
	int status = pm_planes_agree(o ? build(o, g, order, planes) : pm_failed(), planes);
	if (!status && !(o->faces = pm_mg_faces_new(g, order, planes))) /* on all ranks or on none */
		status = pm_failed();
	return status ? pm_mg_walls_free(o) : o;
}

/* The charge of a node on a wall: A u - f, where u is 0 on the walls. u, f: of the node itself. */
static double induced(const struct mg_walls *o, const size_t at[3], const double *u, const double *f)
{
	const struct pm_grid *g = &o->grid;
	const ptrdiff_t step[3] = {1, (ptrdiff_t)g->points[0], (ptrdiff_t)(g->points[0] * g->points[1])};
	double sum = -*f;
	for (int s = 0; s < o->stencil.n; s++) {
		ptrdiff_t to = 0;
		bool inside = true;
		for (int d = 0; d < 3; d++) {
			const size_t x = at[d] + (size_t)(ptrdiff_t)o->stencil.shift[s][d];
			inside &= x < g->points[d];
			to += step[d] * o->stencil.shift[s][d];
		}
		sum += inside ? o->stencil.w[s] * u[to] : 0;
	}
	return sum;
}

/* On the nodes of a face that are here; u has a plane more on either side where ranks share it. */
static void charge_face(struct mg_walls *o, int d, int side, const double *u, const double *f)
{
	const struct pm_grid *g = &o->grid;
	const int low = d == 0, high = d == 2 ? 1 : 2;
	size_t from, to;
	pm_boundary_here(&o->charge, d, side, &from, &to);
	#pragma omp parallel for num_threads(pm_threads()) if (to - from > 4096)
	for (size_t i = from; i < to; i++) {
		const size_t node = pm_boundary_node(&o->charge, d, side, i);
		size_t at[3];
		at[d] = side ? g->points[d] - 1 : 0, at[low] = i % g->points[low], at[high] = i / g->points[low];
		o->charge.value[d][side][i] = induced(o, at, u + node, f + node);
	}
}

int pm_mg_walls_source(int status, struct mg_walls *o, const double *u, double *f, double *room)
{
	const struct pm_planes *p = &o->planes;
	double *copy = NULL;
	const double *with = u;
	if (p->divided)
		status = pm_planes_halo(status, p, 1, 1, &u, &with, &copy);
	for (int a = 0; a < 2 * o->grid.dim; a++) {
		if (!status)
			charge_face(o, a / 2, a % 2, with, f);
		status = pm_boundary_share(status, &o->charge, a / 2, a % 2, o->charge.value[a / 2][a % 2]);
	}
	pm_free(copy);
	status = pm_mg_faces_apply(status, o->faces, &o->charge, &o->wall);
	if (status)
		return status;
	pm_boundary_known(&o->wall, o->order, PM_BOUNDARY_ALL, NULL, room);
	#pragma omp parallel for num_threads(pm_threads()) if (p->here * p->size > mg_parallel)
	for (size_t i = 0; i < p->here * p->size; i++)
		f[i] -= room[i];
	return 0;
}

void pm_mg_walls_set(const struct mg_walls *o, double *phi) { pm_boundary_set(&o->wall, phi); }
