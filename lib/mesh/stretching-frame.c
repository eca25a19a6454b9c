/* Vorticity and velocity in, the change of the vorticity out; the derivatives are gradient.c's. The conservative form makes the products omega_d u_c of one
 * component at a time: memory of three scalar fields. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "fft/axis-transform.h"
#include "law/law.h"
#include "mesh/gradient-parts.h"
#include "mesh/stretching-frame.h"
#include "stream/declare.h"
#include "world/world.h"

/* A field of 3 components on the nodes. */
static const struct pm_field *vector(struct pm_frame *f, const char *on, const char *name, const char *words)
{
	const struct pm_field *p = pm_frame_field(f, on, name);
	if (!p)
		return pm_fail(PM_DATA, "no field '%s' on mesh '%s' (run %s first)", name, on, words), NULL;
	if (p->components != 3)
		return pm_fail(PM_DATA, "'%s' on '%s' has %d components, and vorticity and velocity have 3", name, on, p->components), NULL;
	for (int c = 0; c < 3; c++)
		for (int d = 0; d < 3; d++)
			if (p->staggered[c][d])
				return pm_fail(PM_DATA, "'%s' on '%s' is staggered (stretch works on the nodes)", name, on), NULL;
	return pm_reads(f, on, name);
}

static int contribute(const struct pm_stretching_choice *o, struct pm_frame *f, const struct pm_law *law, struct pm_stretching *t)
{
	char name[PM_NAME];
	snprintf(name, sizeof name, "d%.62s", law->density);
	t->change = pm_contributes(f, t->omega->on, name, law->strength, 3, "stretching", o->replace);
	if (!t->change)
		return -PM_DATA;
	pm_field_inherit(t->change, t->omega);
	return 0;
}

int pm_stretching_declare(const struct pm_stretching_choice *o, struct pm_frame *f, struct pm_stretching *t)
{
	const struct pm_law *law = pm_law_of(f);
	const struct pm_mesh *mesh = pm_frame_mesh(f, o->mesh);
	struct pm_operator trial;
	if (!law)
		return -PM_DATA;
	if (!law->vector || !law->density || !law->field)
		return pm_fail(PM_DATA, "the law '%s' has no vorticity to stretch (the law vortex has)", law->name);
	if (!mesh)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n CELLS makes one)", o->mesh ? " " : "", o->mesh ? o->mesh : "");
	*t = (struct pm_stretching){.grid = pm_grid_of(f, mesh), .form = o->form, .order = pm_order_find(o->order ? o->order : law->order)};
	t->omega = t->order < 0 ? NULL : vector(f, mesh->name, law->density, "p2m");
	t->u = t->omega ? vector(f, mesh->name, law->field, "p2m | poisson-fft | mgrad") : NULL;
	if (!t->u || pm_operator_stretch(&trial, &t->grid, t->form, 0, t->order))
		return t->order < 0 ? -PM_USAGE : -PM_DATA;
	return contribute(o, f, law, t);
}

/* out (+)= the operator of form and component. */
static int apply(const struct pm_stretching *t, int component, bool add, struct pm_fft_plans *plans, const double *const in[], double *const out[])
{
	struct pm_operator o;
	int status = pm_operator_stretch(&o, &t->grid, t->form, component, t->order);
	o.add = add;
	for (int d = 0; d < 3; d++)
		o.weight[d] = pm_in(t->omega, d);
	status = pm_world_agree(status ? status : pm_operator_plan(&o, plans));
	return status ? status : pm_operator_apply_planes(&o, 1, t->omega, in, out, NULL);
}

static int conservative(const struct pm_stretching *t, bool add, struct pm_fft_plans *plans)
{
	const size_t n = t->u->count;
	double *product = pm_alloc(3 * n + 1, sizeof *product);
	const double *const in[3] = {product, product + n, product + 2 * n};
	int status = pm_world_agree(product ? 0 : -PM_DATA);
	for (int c = 0; c < 3 && !status; c++) {
		const double *u = pm_in(t->u, c);
		double *const out[1] = {pm_out(t->change, c)};
		for (int d = 0; d < 3; d++) {
			const double *omega = pm_in(t->omega, d);
			double *to = product + (size_t)d * n;
#pragma omp parallel for schedule(static) if (n > 16384)
			for (size_t i = 0; i < n; i++)
				to[i] = omega[i] * u[i];
		}
		status = pm_world_agree(apply(t, c, add, plans, in, out));
	}
	pm_free(product);
	return status;
}

int pm_stretching_add(struct pm_stretching *t, struct pm_fft_plans *plans)
{
	const double *const u[3] = {pm_in(t->u, 0), pm_in(t->u, 1), pm_in(t->u, 2)};
	double *const out[3] = {pm_out(t->change, 0), pm_out(t->change, 1), pm_out(t->change, 2)};
	const bool add = t->change->nterms > 1;
	if (plans->n > PM_FFT_PLANS - 3) /* frames of many sizes: empty the collection */
		pm_fft_plans_clear(plans);
	return t->form == PM_STRETCH_CONSERVATIVE ? conservative(t, add, plans) : apply(t, 0, add, plans, u, out);
}
