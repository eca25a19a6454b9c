/* Is it the potential of its sources? On the first mesh with density rho and potential phi, lap phi = c rho, F = -grad phi:
 *   flux            = surface sum of -d phi/dn over the planes half-way between the nodes of a box and those around it (Gauss: -c times what is inside)
 *   flux_enclosed   = -c sum of rho over the nodes of the box, less its mean where no face fixes phi
 *   field_residual  = rms (c rho - lap phi) over rms (c rho), differences of order 2, on nodes that are on no face; without walls up to a constant
 *   field_curl      = largest |curl F| h over the largest |F|, with the differences that made F, away from faces; h the smallest spacing
 * Of fields that evolve by Maxwell's equations flux and flux_enclosed are those of the energy (measure-poynting.c).
 * Differences of order 2 on both sides make flux and flux_enclosed equal to round-off for poisson-fft --symbol fd2, poisson-mg and poisson-relax; others leave
 * order h^2. Cost: passes over the mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/measure-field.h"

#include <string.h>

#include "fft/fftw-plan.h"
#include "law/law.h"
#include "measure/law-field.h"
#include "mesh/gradient-frame.h"
#include "mesh/mesh-sum.h"
#include "stream/declare.h"

static const char *const magnetic = "B";

static bool wanted(const struct pm_measure *how) { return (how->field_errors || how->flux) && !how->vector && !how->evolves; }

/* The mesh with Yee's E and B, if their flux is wanted. */
static const struct pm_mesh *lit(const struct pm_measure *how, const struct pm_frame *f)
{
	for (size_t i = 0; how->flux && how->evolves && i < f->nmeshes; i++) {
		const struct pm_field *e = pm_frame_field(f, f->meshes[i]->name, how->field), *b = pm_frame_field(f, f->meshes[i]->name, magnetic);
		if (e && b && e->components == 3 && b->components == 3 && e->staggered[0][0])
			return f->meshes[i];
	}
	return NULL;
}

static const struct pm_mesh *solved(const struct pm_measure *how, const struct pm_frame *f)
{
	for (size_t i = 0; wanted(how) && how->potential && i < f->nmeshes; i++)
		if (pm_frame_field(f, f->meshes[i]->name, how->density) && pm_frame_field(f, f->meshes[i]->name, how->potential))
			return f->meshes[i];
	return NULL;
}

bool pm_field_known(const struct pm_measure *how, const struct pm_frame *f) { return solved(how, f) || lit(how, f); }

void pm_flux_nodes(const struct pm_measure *how, const struct pm_grid *g, int d, size_t *first, size_t *end)
{
	const double slack = 1e-9 * g->h[d];
	*first = 0, *end = d < g->dim ? 0 : 1;
	for (size_t i = 0; d < g->dim && i < g->points[d]; i++) {
		const double x = g->lo[d] + (double)i * g->h[d];
		if (x < how->flux[d] - slack)
			*first = i + 1;
		if (x <= how->flux[g->dim + d] + slack)
			*end = i + 1;
	}
}

int pm_field_reads(const struct pm_measure *how, struct pm_frame *f)
{
	const struct pm_mesh *light = lit(how, f), *mesh = light ? light : solved(how, f);
	if (!mesh)
		return 0;
	if (light)
		pm_reads(f, mesh->name, how->field), pm_reads(f, mesh->name, magnetic);
	else
		pm_reads(f, mesh->name, how->density), pm_reads(f, mesh->name, how->potential);
	if (how->field_errors && !light)
		pm_law_field_reads(how, f);
	const struct pm_grid g = pm_grid_of(f, mesh);
	if (how->flux && how->nflux != 2 * g.dim)
		return pm_fail(PM_USAGE, "--flux-box needs %d numbers, the lower corner of a box and the upper one", 2 * g.dim);
	for (int d = 0; d < g.dim && how->flux; d++) {
		size_t first, end;
		pm_flux_nodes(how, &g, d, &first, &end);
		if (first >= end || first == 0 || end >= g.points[d])
			return pm_fail(PM_DATA, "--flux-box must have nodes of the mesh inside and around it, but along %c it goes from %g to %g "
				"in a mesh from %g to %g", "xyz"[d], how->flux[d], how->flux[g.dim + d], g.lo[d], g.lo[d] + (double)(g.points[d] - 1) * g.h[d]);
	}
	return 0;
}

/* Are all nodes up to `reach` away in the mesh? */
static bool within(const struct pm_grid *g, size_t p, size_t reach)
{
	const size_t at[3] = {p % g->points[0], p / g->points[0] % g->points[1], p / g->points[0] / g->points[1]};
	bool in = true;
	for (int d = 0; d < g->dim; d++)
		in = in && (g->face[d][0] == PM_PERIODIC || (at[d] >= reach && at[d] + reach < g->points[d]));
	return in;
}

/* Does no face fix phi? Then the mean of rho has no field. */
static bool unfixed(const struct pm_grid *g)
{
	bool none = true;
	for (int d = 0; d < g->dim; d++)
		none = none && (g->face[d][0] == PM_PERIODIC || (g->face[d][0] == PM_NEUMANN && g->face[d][1] == PM_NEUMANN));
	return none;
}

static void flux(const struct pm_measure *how, const struct pm_grid *g, const double *rho, const double *phi, double *through, double *enclosed)
{
	const size_t step[3] = {1, g->points[0], g->points[0] * g->points[1]};
	size_t first[3], end[3];
	struct pm_sum surface = {0, 0}, inside = {0, 0};
	const double cells = (double)g->cells[0] * (double)g->cells[1] * (double)g->cells[2], mean = unfixed(g) ? pm_grid_sum(g, rho, NULL) / cells : 0;
	for (int d = 0; d < 3; d++)
		pm_flux_nodes(how, g, d, &first[d], &end[d]);
	for (size_t k = first[2]; k < end[2]; k++)
		for (size_t j = first[1]; j < end[1]; j++)
			for (size_t i = first[0]; i < end[0]; i++) {
				const size_t at[3] = {i, j, k}, p = i + step[1] * j + step[2] * k;
				pm_sum_add(&inside, rho[p] - mean);
				for (int d = 0; d < g->dim; d++) {
					if (at[d] == first[d])
						pm_sum_add(&surface, (phi[p] - phi[p - step[d]]) / (g->h[d] * g->h[d]));
					if (at[d] + 1 == end[d])
						pm_sum_add(&surface, (phi[p] - phi[p + step[d]]) / (g->h[d] * g->h[d]));
				}
			}
	*through = pm_sum_total(surface) * pm_grid_cell(g);
	*enclosed = -how->coefficient * pm_sum_total(inside) * pm_grid_cell(g);
}


static double residual(const struct pm_measure *how, const struct pm_grid *g, const double *rho, const double *phi)
{
	const size_t *n = g->points, step[3] = {1, n[0], n[0] * n[1]};
	struct pm_sum sum = {0, 0}, squares = {0, 0}, source = {0, 0};
	double count = 0, mean = 0;
	for (int pass = unfixed(g) ? 0 : 1; pass < 2; pass++) {
		for (size_t p = 0; p < pm_grid_size(g); p++) {
			const size_t at[3] = {p % n[0], p / n[0] % n[1], p / n[0] / n[1]};
			if (!within(g, p, 1))
				continue;
			double r = how->coefficient * rho[p];
			for (int d = 0; d < g->dim; d++) {
				const size_t around = (n[d] - 1) * step[d];
				const size_t low = at[d] ? p - step[d] : p + around, high = at[d] + 1 < n[d] ? p + step[d] : p - around;
				r -= (phi[low] - 2 * phi[p] + phi[high]) / (g->h[d] * g->h[d]);
			}
			if (pass == 0)
				pm_sum_add(&sum, r), count++;
			else
				pm_sum_add(&squares, (r - mean) * (r - mean)), pm_sum_add(&source, pow(how->coefficient * rho[p] - mean, 2));
		}
		mean = count > 0 ? pm_sum_total(sum) / count : 0;
	}
	return sqrt(pm_sum_total(squares) / pm_sum_total(source));
}

static int curl(const struct pm_measure *how, const struct pm_frame *f, const struct pm_field *phi, const struct pm_grid *g, double *value)
{
	struct pm_law_field law = {0};
	struct pm_operator o;
	struct pm_fft_plans plans = {0};
	const char *order = NULL;
	const size_t n = pm_grid_size(g);
	double most = 0, largest = 0, h = g->h[0], *room = NULL;
	int status = pm_law_field_of(how, f, &law);
	if (!status && law.field)
		order = pm_gradient_order_of(law.field) ? pm_gradient_order_of(law.field) : pm_gradient_order_of(phi);
	order = order ? order : pm_law_of(f)->order ? pm_law_of(f)->order : "2";
	if (status || !law.field || law.field->components != g->dim || strcmp(law.field->on, phi->on) || how->vortices || g->dim < 2 ||
			pm_operator_init(&o, g, PM_OP_CURL, pm_order_find(order), g->dim, false))
		goto out;
	status = (room = pm_alloc(n * (size_t)o.out, sizeof *room)) ? pm_operator_plan(&o, &plans) : -PM_DATA;
	const double *in[3] = {pm_in(law.field, 0), pm_in(law.field, 1), g->dim > 2 ? pm_in(law.field, 2) : NULL};
	if (!status)
		status = pm_operator_apply(&o, 1, in, (double *const[]){room, room + n, room + 2 * n}, NULL);
	for (size_t p = 0; p < n && !status; p++)
		for (int c = 0; c < o.out && within(g, p, (size_t)o.order / 2); c++)
			most = fmax(most, fabs(room[p + (size_t)c * n]));
	for (size_t p = 0; p < n; p++)
		for (int d = 0; d < g->dim; d++)
			largest = fmax(largest, fabs(in[d][p])), h = fmin(h, g->h[d]);
	*value = most * h / largest;
out:
	pm_fft_plans_clear(&plans);
	pm_law_field_free(&law);
	pm_free(room);
	return status;
}

int pm_field_of(const struct pm_measure *how, const struct pm_frame *f, double value[PM_FIELD_COLUMNS])
{
	const struct pm_mesh *mesh = solved(how, f), *light = lit(how, f);
	for (int k = 0; k < PM_FIELD_COLUMNS; k++)
		value[k] = NAN;
	if (light) {
		const struct pm_grid g = pm_grid_of(f, light);
		pm_poynting_of(how, &g, pm_frame_field(f, light->name, how->field), pm_frame_field(f, light->name, magnetic), &value[PM_FLUX],
			&value[PM_FLUX_ENCLOSED]);
	}
	if (!mesh)
		return 0;
	const struct pm_field *rho = pm_frame_field(f, mesh->name, how->density), *phi = pm_frame_field(f, mesh->name, how->potential);
	const struct pm_grid g = pm_grid_of(f, mesh);
	if (how->flux)
		flux(how, &g, pm_in(rho, 0), pm_in(phi, 0), &value[PM_FLUX], &value[PM_FLUX_ENCLOSED]);
	if (!how->field_errors)
		return 0;
	value[PM_FIELD_RESIDUAL] = residual(how, &g, pm_in(rho, 0), pm_in(phi, 0));
	return curl(how, f, phi, &g, &value[PM_FIELD_CURL]);
}
