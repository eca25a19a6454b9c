/* What diag measures of fields that evolve: eps0/2 int E^2, eps0 c^2/2 int B^2, each component over the points where it sits, those on faces with half weight;
 * and Gauss's law with the rho of p2m. Both energies are of the time of the frame; with Yee's scheme their sum varies by (omega dt)^2/8 of itself about what
 * the scheme conserves. Missing quantities are NAN. Cost: a pass over six components. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "maxwell-parts/yee-waves.h"
#include "measure/measure.h"
#include "mesh/mesh-sum.h"
#include "stream/declare.h"
#include "stream/over-stretches.h"

static const char *const magnetic = "B";

/* The mesh with E, and B there; NULL none. */
static const struct pm_mesh *mesh_of(const struct pm_measure *how, const struct pm_frame *f)
{
	for (size_t i = 0; i < f->nmeshes && how->evolves; i++)
		if (pm_frame_field(f, f->meshes[i]->name, how->field) && pm_frame_field(f, f->meshes[i]->name, magnetic))
			return f->meshes[i];
	return NULL;
}

void pm_maxwell_reads(const struct pm_measure *how, struct pm_frame *f)
{
	const struct pm_mesh *mesh = mesh_of(how, f);
	if (!mesh)
		return;
	pm_reads(f, mesh->name, how->field);
	pm_reads(f, mesh->name, magnetic);
	if (pm_frame_field(f, mesh->name, how->density))
		pm_reads(f, mesh->name, how->density);
}

struct component {
	const struct pm_grid *g;
	const unsigned char *half;
	const double *a;
	size_t before; /* rows of the mesh before those here */
};

static void make(const void *data, size_t from, size_t to, void *part)
{
	const struct component *c = data;
	const struct pm_grid *g = c->g;
	const size_t row = c->before + from / (to - from), j = row % g->points[1], k = row / g->points[1];
	const double across = pm_grid_weight(g, g->cells[0] > 1, c->half[1] ? g->cells[1] > 1 : j, c->half[2] ? g->cells[2] > 1 : k);
	struct pm_sum sum = {0, 0};
	for (size_t i = from; i < to; i++) {
		const bool end = !c->half[0] && g->points[0] > g->cells[0] && (i == from || i + 1 == to);
		pm_sum_add(&sum, across * (end ? 0.5 : 1) * c->a[i] * c->a[i]);
	}
	*(struct pm_sum *)part = sum;
}

/* The integral of the square of a component that sits half a cell up the axes of half[]. */
static double square(const struct pm_grid *g, const struct pm_field *field, const unsigned char half[3], const double *a)
{
	struct pm_sum all = {0, 0};
	const struct pm_parts parts = {.size = sizeof all, .make = make, .join = pm_join_sums};
	pm_grid_over(g, field, &parts, &(struct component){g, half, a, pm_grid_rows_before(g, field)}, &all);
	return pm_sum_total(all) * pm_grid_cell(g);
}

static double energy(const struct pm_grid *g, const struct pm_field *field)
{
	double sum = 0;
	for (int c = 0; c < field->components; c++)
		sum += 0.5 * square(g, field, field->staggered[c], pm_in(field, c));
	return sum;
}

static double largest(const struct pm_field *field, const double *a)
{
	double most = 0;
	for (size_t i = 0; i < field->count; i++)
		most = fmax(most, fabs(a[i]));
	return pm_most_of_stretches(field, most);
}

/* Of what is charged anywhere; NAN without charge. Of ranks each has a plane more of E on either side. */
static int residual(const struct pm_measure *how, const struct pm_grid *g, const struct pm_field *e, const struct pm_field *rho, double *got)
{
	struct pm_yee y = {.grid = *g, .c = how->c, .eps0 = how->eps0, .nodal = !e->staggered[0][0]};
	struct pm_planes planes;
	double *div = pm_alloc(e->count + 1, sizeof *div), *room = NULL;
	int status = div ? pm_planes_init(&planes, g, e) : (planes.from = NULL, -PM_DATA);
	for (int c = 0; c < 3; c++)
		y.e[c] = (double *)pm_in(e, c);
	if (e->here) {
		y.planes = &planes;
		status = pm_planes_halo(status, &planes, 1, 3, (const double *const *)y.e, y.beside, &room);
	}
	if (!status && pm_yee_spectral(e))
		status = pm_yee_waves_divergence(&y, pm_in(rho, 0), div);
	else if (!status)
		pm_yee_divergence(&y, pm_in(rho, 0), div);
	if (!status)
		*got = largest(e, div) * how->eps0 / largest(rho, pm_in(rho, 0));
	pm_planes_free(&planes), pm_free(div), pm_free(room);
	return status;
}

int pm_maxwell_of(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m)
{
	const struct pm_mesh *mesh = mesh_of(how, f);
	m->value[PM_ENERGY_ELECTRIC] = m->value[PM_ENERGY_MAGNETIC] = m->value[PM_GAUSS_RESIDUAL] = NAN;
	if (!mesh)
		return 0;
	const struct pm_field *e = pm_frame_field(f, mesh->name, how->field), *b = pm_frame_field(f, mesh->name, magnetic);
	const struct pm_field *rho = pm_frame_field(f, mesh->name, how->density);
	const struct pm_grid g = pm_grid_of(f, mesh);
	m->value[PM_ENERGY_ELECTRIC] = how->eps0 * energy(&g, e);
	m->value[PM_ENERGY_MAGNETIC] = how->eps0 * how->c * how->c * energy(&g, b);
	return rho && e->components == 3 ? residual(how, &g, e, rho, &m->value[PM_GAUSS_RESIDUAL]) : 0;
}
