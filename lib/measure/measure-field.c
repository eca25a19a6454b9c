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
#include "mesh/gradient-parts.h"
#include "mesh/mesh-sum.h"
#include "stream/declare.h"
#include "world/world.h"

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
static bool within(const struct pm_grid *g, const size_t at[3], size_t reach)
{
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

/* Density and potential of the planes here; phi with those of the neighbours, where ranks share them. */
struct solved {
	const struct pm_measure *how;
	const struct pm_grid *g;
	struct pm_planes planes;
	const double *rho, *phi;
	double mean;                       /* subtracted from rho, or from the residual */
	size_t first[3], end[3], step[3];  /* nodes of the box; strides */
};

/* The place of value p of those here. */
static void place(const struct solved *s, size_t p, size_t at[3])
{
	const size_t *n = s->g->points, row = pm_planes_row(&s->planes, p);
	at[0] = p % n[0], at[1] = row % n[1], at[2] = row / n[1];
}

enum { SURFACE, INSIDE, SUMS };

/* A row of the box. */
static void make_flux(const void *data, size_t from, size_t to, void *part)
{
	const struct solved *s = data;
	const struct pm_grid *g = s->g;
	struct pm_sum *sum = part;
	size_t at[3];
	place(s, from, at);
	if (at[1] < s->first[1] || at[1] >= s->end[1] || at[2] < s->first[2] || at[2] >= s->end[2] || to == from)
		return;
	for (at[0] = s->first[0]; at[0] < s->end[0]; at[0]++) {
		const double *phi = s->phi + from + at[0];
		pm_sum_add(&sum[INSIDE], s->rho[from + at[0]] - s->mean);
		for (int d = 0; d < g->dim; d++) {
			if (at[d] == s->first[d])
				pm_sum_add(&sum[SURFACE], (phi[0] - *(phi - s->step[d])) / (g->h[d] * g->h[d]));
			if (at[d] + 1 == s->end[d])
				pm_sum_add(&sum[SURFACE], (phi[0] - phi[s->step[d]]) / (g->h[d] * g->h[d]));
		}
	}
}

static int flux(struct solved *s, const struct pm_field *density, double *through, double *enclosed)
{
	struct pm_sum sum[SUMS] = {{0, 0}};
	const struct pm_parts parts = {.size = sizeof sum, .make = make_flux, .join = pm_join_sums};
	const double cells = (double)s->g->cells[0] * (double)s->g->cells[1] * (double)s->g->cells[2];
	s->mean = unfixed(s->g) ? pm_grid_sum_of(s->g, density, s->rho, NULL) / cells : 0;
	for (int d = 0; d < 3; d++)
		pm_flux_nodes(s->how, s->g, d, &s->first[d], &s->end[d]);
	const int status = pm_planes_over(0, &s->planes, &parts, s, sum);
	*through = pm_sum_total(sum[SURFACE]) * pm_grid_cell(s->g);
	*enclosed = -s->how->coefficient * pm_sum_total(sum[INSIDE]) * pm_grid_cell(s->g);
	return status;
}

static double residual_at(const struct solved *s, const size_t at[3], size_t p)
{
	const struct pm_grid *g = s->g;
	const double *phi = s->phi + p;
	double r = s->how->coefficient * s->rho[p];
	for (int d = 0; d < g->dim; d++) {
		const bool beside = s->planes.divided && d > 0 && d == s->planes.axis; /* what is beyond a periodic end lies there */
		const size_t around = (g->points[d] - 1) * s->step[d];
		const double low = at[d] || beside ? *(phi - s->step[d]) : phi[around];
		const double high = at[d] + 1 < g->points[d] || beside ? phi[s->step[d]] : *(phi - around);
		r -= (low - 2 * phi[0] + high) / (g->h[d] * g->h[d]);
	}
	return r;
}

enum { RESIDUAL, COUNT, SQUARES, SOURCE, RESIDUALS };

static void make_residual(const void *data, size_t from, size_t to, void *part)
{
	const struct solved *s = data;
	struct pm_sum *sum = part;
	for (size_t p = from; p < to; p++) {
		size_t at[3];
		place(s, p, at);
		if (!within(s->g, at, 1))
			continue;
		const double r = residual_at(s, at, p);
		pm_sum_add(&sum[RESIDUAL], r), pm_sum_add(&sum[COUNT], 1);
		pm_sum_add(&sum[SQUARES], (r - s->mean) * (r - s->mean));
		pm_sum_add(&sum[SOURCE], pow(s->how->coefficient * s->rho[p] - s->mean, 2));
	}
}

static int residual(struct solved *s, double *value)
{
	const struct pm_parts parts = {.size = RESIDUALS * sizeof(struct pm_sum), .make = make_residual, .join = pm_join_sums};
	int status = 0;
	s->mean = 0;
	for (int pass = unfixed(s->g) ? 0 : 1; pass < 2 && !status; pass++) {
		struct pm_sum sum[RESIDUALS] = {{0, 0}};
		status = pm_planes_over(0, &s->planes, &parts, s, sum);
		s->mean = pm_sum_total(sum[COUNT]) > 0 ? pm_sum_total(sum[RESIDUAL]) / pm_sum_total(sum[COUNT]) : 0;
		*value = sqrt(pm_sum_total(sum[SQUARES]) / pm_sum_total(sum[SOURCE]));
	}
	return status;
}

/* The largest curl of F away from faces, and the largest |F|, over all ranks. */
static int largest(const struct solved *s, struct pm_operator *o, const struct pm_field *field, double most[2])
{
	struct pm_fft_plans plans = {0};
	const size_t n = field->count;
	double *room = pm_alloc(n * (size_t)o->out + 1, sizeof *room);
	const double *in[3] = {pm_in(field, 0), pm_in(field, 1), s->g->dim > 2 ? pm_in(field, 2) : NULL};
	int status = pm_planes_agree(room ? pm_operator_plan(o, &plans) : -PM_DATA, &s->planes);
	if (!status)
		status = pm_planes_agree(pm_operator_apply_planes(o, 1, field, in, (double *const[]){room, room + n, room + 2 * n}, NULL), &s->planes);
	for (size_t p = 0; p < n && !status; p++) {
		size_t at[3];
		place(s, p, at);
		for (int c = 0; c < o->out && within(s->g, at, (size_t)o->order / 2); c++)
			most[0] = fmax(most[0], fabs(room[p + (size_t)c * n]));
		for (int d = 0; d < s->g->dim; d++)
			most[1] = fmax(most[1], fabs(in[d][p]));
	}
	pm_fft_plans_clear(&plans), pm_free(room);
	return s->planes.divided ? pm_world_largest(status, 2, most) : status;
}

static int curl(const struct solved *s, const struct pm_frame *f, const struct pm_field *phi, double *value)
{
	struct pm_law_field law = {0};
	struct pm_operator o;
	const struct pm_grid *g = s->g;
	const char *order = NULL;
	double most[2] = {0, 0}, h = g->h[0];
	int status = pm_law_field_of(s->how, f, &law);
	if (!status && law.field)
		order = pm_gradient_order_of(law.field) ? pm_gradient_order_of(law.field) : pm_gradient_order_of(phi);
	order = order ? order : pm_law_of(f)->order ? pm_law_of(f)->order : "2";
	const bool known = !status && law.field && law.field->components == g->dim && !strcmp(law.field->on, phi->on) && !s->how->vortices && g->dim > 1;
	if (known && !pm_operator_init(&o, g, PM_OP_CURL, pm_order_find(order), g->dim, false)) {
		status = largest(s, &o, law.field, most);
		for (int d = 0; d < g->dim; d++)
			h = fmin(h, g->h[d]);
		*value = status ? NAN : most[0] * h / most[1];
	}
	pm_law_field_free(&law);
	return status;
}

/* On all ranks, each with its planes. */
static int of_solved(const struct pm_measure *how, const struct pm_frame *f, const struct pm_mesh *mesh, double value[PM_FIELD_COLUMNS])
{
	const struct pm_field *rho = pm_frame_field(f, mesh->name, how->density), *phi = pm_frame_field(f, mesh->name, how->potential);
	const struct pm_grid g = pm_grid_of(f, mesh);
	struct solved s = {.how = how, .g = &g, .rho = pm_in(rho, 0), .phi = pm_in(phi, 0), .step = {1, g.points[0], g.points[0] * g.points[1]}};
	double *room = NULL;
	int status = pm_planes_init(&s.planes, &g, phi);
	if (s.planes.divided)
		status = pm_planes_halo(status, &s.planes, 1, 1, (const double *const[]){s.phi}, &s.phi, &room);
	if (!status && how->flux)
		status = flux(&s, rho, &value[PM_FLUX], &value[PM_FLUX_ENCLOSED]);
	if (!status && how->field_errors)
		status = residual(&s, &value[PM_FIELD_RESIDUAL]);
	if (!status && how->field_errors)
		status = curl(&s, f, phi, &value[PM_FIELD_CURL]);
	pm_planes_free(&s.planes), pm_free(room);
	return status;
}

int pm_field_of(const struct pm_measure *how, const struct pm_frame *f, double value[PM_FIELD_COLUMNS])
{
	const struct pm_mesh *mesh = solved(how, f), *light = lit(how, f);
	int status = 0;
	for (int k = 0; k < PM_FIELD_COLUMNS; k++)
		value[k] = NAN;
	if (light) {
		const struct pm_grid g = pm_grid_of(f, light);
		status = pm_poynting_of(how, &g, pm_frame_field(f, light->name, how->field), pm_frame_field(f, light->name, magnetic), &value[PM_FLUX],
			&value[PM_FLUX_ENCLOSED]);
	}
	return mesh && !status ? of_solved(how, f, mesh, value) : status;
}
