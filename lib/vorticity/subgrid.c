/* d omega/dt += curl b, b the force of the scales below the mesh:
 *   stress  b = div(2 nu_t S), the stress of the velocity's models itself: takes the energy integral 2 nu_t S:S, never negative
 *   curl    b = -nu_t curl omega: takes the enstrophy integral nu_t (curl omega)^2, never negative, and its energy only where nu_t varies little
 *           (Mansour, Ferziger and Reynolds 1978, Stanford TF-11; Winckelmans et al. 1996, ESAIM Proc. 1, 351)
 *   model hyper: b = -nu_h lap lap u, nu_h = (C D)^2 sqrt(2 <S:S>) (D/pi)^2, <> over the box: the viscosity of Smagorinsky for the wave pi/D and less for
 *           longer ones; the power as in Borue and Orszag 1995, J. Fluid Mech. 306, 293, the coefficient ours
 * A curl has no divergence, and no total in a periodic box: alpha stays to round-off. Both forms are nu lap omega where nu_t is the same everywhere.
 * Cost: dim^2 derivatives for a, as many for b, one curl. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "fft/axis-transform.h"
#include "law/law.h"
#include "mesh/mesh-sum.h"
#include "stream/declare.h"
#include "stream/limits.h"
#include "vorticity/subgrid.h"

const char *const pm_subgrid_forms[] = {"stress", "curl", NULL};

static void term(struct pm_operator *o, int out, int in, int axis, int as)
{
	o->term[o->nterms++] = (struct pm_operator_term){.out = out, .in = in, .axis = axis, .as = as, .sign = 1};
}

/* All du_i/dx_j of a flow, and the divergence of one row of a symmetric tensor after the other: its in is the tensor. */
static void tensors(struct pm_subgrid *t, int order)
{
	const int dim = t->grid.dim;
	const struct pm_operator o = {.grid = t->grid, .kind = PM_OP_DIV, .order = order, .flow = true, .derivative = 1};
	t->gradient = t->divergence = o;
	t->gradient.in = t->divergence.out = dim;
	t->gradient.out = t->divergence.in = dim * dim;
	for (int i = 0; i < dim; i++)
		for (int j = 0; j < dim; j++) {
			term(&t->gradient, i * dim + j, i, j, i);
			/* At a wall across axis j, S_ij is odd like u_j, and S_jj even like the other components. */
			term(&t->divergence, i, i * dim + j, j, i == j ? (j + 1) % dim : j);
		}
}

static int operators(struct pm_subgrid *t, int order)
{
	const int dim = t->grid.dim;
	int status = order < 0 ? -PM_USAGE : pm_operator_init(&t->curl, &t->grid, PM_OP_CURL, order, dim, true);
	status = status ? status : pm_operator_init(&t->curl_omega, &t->grid, PM_OP_CURL, order, t->omega->components, false);
	status = status ? status : pm_operator_init(&t->lap, &t->grid, PM_OP_LAP, order, dim, true);
	tensors(t, order);
	return status;
}

int pm_subgrid_declare(const struct pm_subgrid_choice *c, struct pm_frame *f, struct pm_subgrid *t)
{
	char name[PM_NAME];
	const struct pm_law *law = pm_law_of(f);
	const struct pm_mesh *mesh = pm_frame_mesh(f, c->mesh);
	if (!law)
		return -PM_DATA;
	if (law->of_potential != PM_CURL || !law->density || !law->field || f->dim < 2)
		return pm_fail(PM_DATA, "the law '%s' has no vorticity for a viscosity to act on (the law vortex has)", law->name);
	if (!mesh)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n CELLS makes one)", c->mesh ? " " : "", c->mesh ? c->mesh : "");
	const struct pm_field *omega = pm_frame_field(f, mesh->name, law->density), *u = pm_frame_field(f, mesh->name, law->field);
	if (!omega || !u)
		return pm_fail(PM_DATA, "no field '%s' on mesh '%s' (run p2m | poisson-fft | mgrad first)", omega ? law->field : law->density, mesh->name);
	*t = (struct pm_subgrid){.choice = *c, .grid = pm_grid_of(f, mesh)};
	t->omega = pm_reads(f, mesh->name, law->density), t->u = pm_reads(f, mesh->name, law->field);
	int status = t->omega && t->u ? operators(t, pm_order_find(c->order ? c->order : law->order)) : -PM_DATA;
	if (status)
		return status;
	snprintf(name, sizeof name, "d%.62s", law->density);
	t->change = pm_contributes(f, mesh->name, name, law->strength, t->omega->components, "subgrid", c->replace);
	if (!t->change)
		return -PM_DATA;
	pm_field_inherit(t->change, t->omega);
	return 0;
}

static void columns(double *from, size_t n, int count, double *to[])
{
	for (int c = 0; c < count; c++)
		to[c] = from + (size_t)c * n;
}

static int apply(struct pm_operator *o, struct pm_fft_plans *plans, double factor, const double *const in[], double *const out[])
{
	int status = pm_operator_plan(o, plans);
	return status ? status : pm_operator_apply(o, factor, in, out, NULL);
}

/* nu[n] from the gradient a. D^2 is `square`. */
static int viscosity(const struct pm_subgrid *t, double square, const double *const u[3], const double *a, double *nu, struct pm_subgrid_numbers *r)
{
	const size_t n = t->u->count;
	const enum pm_eddy_model model = t->choice.model;
	int status = 0;
	double cells = 1; /* the weights of pm_grid_sum add up to it */
	pm_eddy_rate(model, t->grid.dim, n, a, nu);
	r->factor = pm_eddy_factor(model, t->choice.coefficient);
	if (model == PM_EDDY_DYNAMIC)
		status = pm_eddy_dynamic(&t->grid, t->u, u, a, nu, &r->factor);
	for (int d = 0; d < t->grid.dim; d++)
		cells *= (double)t->grid.cells[d];
	if (model == PM_EDDY_HYPER) {
		const double rms = sqrt(pm_grid_sum(&t->grid, nu, nu) / cells);
		for (size_t i = 0; i < n; i++)
			nu[i] = rms;
	}
	r->largest = 0;
	for (size_t i = 0; i < n; i++)
		nu[i] *= fmax(r->factor, 0) * square, r->largest = fmax(r->largest, nu[i]);
	r->mean = pm_grid_sum(&t->grid, nu, NULL) / cells;
	return status;
}

/* b = div(2 nu S); a becomes 2 nu S. */
static int stress(struct pm_subgrid *t, struct pm_fft_plans *plans, const double *nu, double *a, double *const b[])
{
	const size_t n = t->u->count;
	const int dim = t->grid.dim;
	double *row[9];
	columns(a, n, dim * dim, row);
	for (int i = 0; i < dim; i++)
		for (int j = i; j < dim; j++)
			for (size_t p = 0; p < n; p++)
				row[i * dim + j][p] = row[j * dim + i][p] = nu[p] * (row[i * dim + j][p] + row[j * dim + i][p]);
	return apply(&t->divergence, plans, 1, (const double *const *)row, b);
}

/* b = -nu curl omega */
static int curls(struct pm_subgrid *t, struct pm_fft_plans *plans, const double *nu, double *const b[])
{
	const double *omega[3];
	for (int c = 0; c < 3; c++)
		omega[c] = pm_in(t->omega, c < t->omega->components ? c : 0);
	int status = apply(&t->curl_omega, plans, -1, omega, b);
	for (int c = 0; c < t->grid.dim; c++)
		for (size_t p = 0; p < t->u->count; p++)
			b[c][p] *= nu[p];
	return status;
}

/* b = -factor lap lap u; work: dim n */
static int hyper(struct pm_subgrid *t, struct pm_fft_plans *plans, double factor, const double *const u[], double *work, double *const b[])
{
	double *once[3];
	columns(work, t->u->count, t->grid.dim, once);
	int status = apply(&t->lap, plans, 1, u, once);
	return status ? status : apply(&t->lap, plans, -factor, (const double *const *)once, b);
}

int pm_subgrid_add(struct pm_subgrid *t, struct pm_fft_plans *plans, struct pm_subgrid_numbers *r)
{
	const size_t n = t->u->count;
	const int dim = t->grid.dim;
	double *room = pm_alloc((size_t)(dim * dim + dim + 1) * n, sizeof *room), *a[9], *b[3], *out[3], square = 1;
	double *nu = room + (size_t)(dim * dim + dim) * n;
	const double *u[3];
	int status = room ? 0 : -PM_DATA;
	if (plans->n > PM_FFT_PLANS - 3) /* frames of many sizes: empty the collection */
		pm_fft_plans_clear(plans);
	columns(room, n, dim * dim, a);
	columns(room + (size_t)(dim * dim) * n, n, dim, b);
	for (int d = 0; d < 3; d++) {
		u[d] = pm_in(t->u, d < dim ? d : 0);
		out[d] = pm_out(t->change, d < t->change->components ? d : 0);
		square *= d < dim ? t->grid.h[d] : 1;
	}
	const double cell = square;
	square = pow(cell, 2.0 / dim);
	status = status ? status : apply(&t->gradient, plans, 1, u, a);
	status = status ? status : viscosity(t, square, u, room, nu, r);
	const bool hyperviscous = t->choice.model == PM_EDDY_HYPER;
	const double fourth = r->largest * square / (pm_pi * pm_pi), fastest = pm_operator_fastest(&t->lap);
	if (!status)
		status = hyperviscous ? hyper(t, plans, fourth, u, room, b) :
			t->choice.form == PM_SUBGRID_CURL ? curls(t, plans, nu, b) : stress(t, plans, nu, room, b);
	r->dissipation = 0;
	for (int d = 0; d < dim && !status; d++)
		r->dissipation -= cell * pm_grid_sum(&t->grid, u[d], b[d]);
	t->curl.add = t->change->nterms > 1;
	status = status ? status : apply(&t->curl, plans, 1, (const double *const *)b, out);
	pm_limits_add(t->change, (struct pm_limits){.decay = hyperviscous ? fourth * fastest * fastest : r->largest * fastest});
	pm_free(room);
	return status;
}
