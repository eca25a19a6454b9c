/* The law's density in, its rate of change out; the Laplacian L is gradient.c's. Where nu varies (nu L f + L(nu f) - f L nu)/2: with the weights c_j of L
 * this is the sum of c_j (f_i+j - f_i) times the mean of the nu of both points, for order 2 the fluxes of faces with mean nu. It is as symmetric as L, so the
 * sum stays, and of the same order.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "fft/axis-transform.h"
#include "law/law.h"
#include "mesh/diffusion-frame.h"
#include "world/world.h"
#include "mesh/gradient-parts.h"
#include "stream/declare.h"
#include "stream/limits.h"

/* The mesh change field d<density> of the strength. */
static int contribute(const struct pm_diffusion_choice *o, struct pm_frame *f, const char *of, struct pm_diffusion *t)
{
	char name[PM_NAME];
	snprintf(name, sizeof name, "d%.62s", t->density->name);
	t->change = pm_contributes(f, t->density->on, name, of, t->density->components, "diffusion", o->replace);
	if (!t->change)
		return -PM_DATA;
	pm_field_inherit(t->change, t->density);
	return 0;
}

static bool has_state(const struct pm_frame *f, const char *name)
{
	bool any = false;
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_field *state = pm_frame_field(f, f->sets[i]->name, name);
		any = any || (state && state->role == PM_STATE);
	}
	return any;
}

int pm_diffusion_declare(const struct pm_diffusion_choice *o, struct pm_frame *f, struct pm_diffusion *t)
{
	const struct pm_law *law = pm_law_of(f);
	const struct pm_mesh *mesh = pm_frame_mesh(f, o->mesh);
	if (!law)
		return -PM_DATA;
	/* The law's strength has its density, every other field a density of its own name. */
	const bool own = !o->field || (law->strength && !strcmp(o->field, law->strength));
	const char *density = own ? law->density : o->field;
	if (!density)
		return pm_fail(PM_DATA, "the law '%s' has no density on a mesh to diffuse (--field NAME, deposited by p2m --strength NAME --field NAME)",
			law->name);
	if (!mesh)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n CELLS makes one)", o->mesh ? " " : "", o->mesh ? o->mesh : "");
	if (!pm_frame_field(f, mesh->name, density) && own)
		return pm_fail(PM_DATA, "no field '%s' on mesh '%s' (run p2m first)", density, mesh->name);
	if (!pm_frame_field(f, mesh->name, density))
		return pm_fail(PM_DATA, "no field '%s' on mesh '%s' (p2m --strength %s --field %s makes it of particles)", density, mesh->name, density,
			density);
	if (!own && !has_state(f, o->field))
		return pm_fail(PM_DATA, "no particles have a state '%s' whose rate of change this would be (mgrad --operator lap gives the Laplacian alone)",
			o->field);
	*t = (struct pm_diffusion){.density = pm_reads(f, mesh->name, density), .nu = {o->nu[0], o->nu[1], o->nu[2]}};
	if (!t->density)
		return -PM_DATA;
	struct pm_grid g = pm_grid_of(f, mesh);
	int order = pm_order_find(o->order ? o->order : law->order ? law->order : "2");
	int status = order < 0 ? -PM_USAGE : pm_operator_init(&t->operator, &g, PM_OP_LAP, order, t->density->components, false);
	for (int k = 0; k < t->operator.nterms && !status; k++)
		t->operator.term[k].sign *= o->nu[t->operator.term[k].axis];
	for (int d = 0; d < g.dim; d++)
		for (int side = 0; side < 2; side++)
			g.face[d][side] = g.face[d][side] == PM_WALL ? PM_NEUMANN : g.face[d][side];
	status = status ? status : pm_operator_init(&t->even, &g, PM_OP_LAP, order, 1, false);
	return status ? status : contribute(o, f, own ? law->strength : o->field, t);
}

/* change += sum over axes of nu d2(density)/dx2 */
static int add(struct pm_diffusion *t)
{
	const double *in[PM_COMPONENTS];
	double *out[PM_COMPONENTS];
	t->operator.add = t->change->nterms > 1;
	for (int c = 0; c < t->operator.in; c++) {
		in[c] = pm_in(t->density, c);
		out[c] = pm_out(t->change, c);
	}
	return pm_operator_apply_planes(&t->operator, 1, t->density, in, out, NULL);
}

/* change += (nu L f + L(nu f) - f L nu)/2 */
static int add_varying(struct pm_diffusion *t, const double *nu)
{
	const size_t n = t->density->count, fields = (size_t)t->operator.in;
	double *room = pm_alloc((3 * fields + 1) * n + 1, sizeof *room), *curved = room, *lap[PM_COMPONENTS], *both[PM_COMPONENTS];
	const double *f[PM_COMPONENTS], *product[PM_COMPONENTS];
	const bool more = t->change->nterms > 1;
	int status = pm_world_agree(room ? 0 : pm_failed());
	for (size_t c = 0; c < fields && !status; c++) {
		double *of = room + (3 * c + 3) * n;
		f[c] = pm_in(t->density, (int)c), product[c] = of, lap[c] = of - n, both[c] = of - 2 * n;
		for (size_t i = 0; i < n; i++)
			of[i] = nu[i] * f[c][i];
	}
	t->operator.add = t->even.add = false;
	status = status ? status : pm_operator_apply_planes(&t->even, 1, t->density, &nu, &curved, NULL);
	status = status ? status : pm_operator_apply_planes(&t->operator, 1, t->density, f, lap, NULL);
	status = status ? status : pm_operator_apply_planes(&t->operator, 1, t->density, product, both, NULL);
	for (size_t c = 0; c < fields && !status; c++) {
		double *out = pm_out(t->change, (int)c);
#pragma omp parallel for schedule(static) if (n > 4096)
		for (size_t i = 0; i < n; i++)
			out[i] = (more ? out[i] : 0) + 0.5 * (nu[i] * lap[c][i] + both[c][i] - f[c][i] * curved[i]);
	}
	pm_free(room);
	return status;
}

/* Of order 2 no mode decays faster than with the largest nu everywhere. Weights of L below 0 (4: -1/12; 6: -3/20; spectral: -2/j^2, j even) that lack their
 * share of it add at most twice their sum, which is this part of the largest rate. */
static double fastest(const struct pm_diffusion *t, const struct pm_diffusion_nu *varies)
{
	const double slack[] = {1.0 / 3, 0, 1.0 / 16, 27.0 / 272}; /* order 0 (spectral), 2, 4, 6 */
	const double largest = pm_operator_fastest(&t->operator);
	return varies->at ? largest * (varies->most + (varies->most - varies->least) * slack[t->operator.order / 2]) : largest;
}

int pm_diffusion_add(struct pm_diffusion *t, const struct pm_diffusion_nu *varies, struct pm_fft_plans *plans, double *decay)
{
	if (plans->nmade > PM_FFT_PLANS - 6 || plans->n > PM_FFT_PLANS - 6) /* frames of many sizes: empty the collection */
		pm_fft_plans_clear(plans);
	int status = pm_operator_plan(&t->operator, plans);
	status = pm_world_agree(status || !varies->at ? status : pm_operator_plan(&t->even, plans));
	if (!status)
		status = varies->at ? add_varying(t, varies->at) : add(t);
	*decay = fastest(t, varies);
	pm_limits_add(t->change, (struct pm_limits){.decay = *decay});
	return status;
}
