/* The law's density in, its rate of change out; the Laplacian is gradient.c's.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "fft/axis-transform.h"
#include "law/law.h"
#include "mesh/diffusion-frame.h"
#include "stream/declare.h"
#include "stream/limits.h"

/* The mesh change field d<density> of the law's strength. */
static int contribute(const struct pm_diffusion_choice *o, struct pm_frame *f, const struct pm_law *law, struct pm_diffusion *t)
{
	char name[PM_NAME];
	snprintf(name, sizeof name, "d%.62s", law->density);
	t->change = pm_contributes(f, t->density->on, name, law->strength, t->density->components, "diffusion", o->replace);
	if (!t->change)
		return -PM_DATA;
	pm_field_inherit(t->change, t->density);
	return 0;
}

int pm_diffusion_declare(const struct pm_diffusion_choice *o, struct pm_frame *f, struct pm_diffusion *t)
{
	const struct pm_law *law = pm_law_of(f);
	const struct pm_mesh *mesh = pm_frame_mesh(f, o->mesh);
	if (!law)
		return -PM_DATA;
	if (!law->density)
		return pm_fail(PM_DATA, "the law '%s' has no density on a mesh to diffuse", law->name);
	if (!mesh)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n CELLS makes one)", o->mesh ? " " : "", o->mesh ? o->mesh : "");
	if (!pm_frame_field(f, mesh->name, law->density))
		return pm_fail(PM_DATA, "no field '%s' on mesh '%s' (run p2m first)", law->density, mesh->name);
	*t = (struct pm_diffusion){.density = pm_reads(f, mesh->name, law->density), .nu = o->nu};
	if (!t->density)
		return -PM_DATA;
	struct pm_grid g = pm_grid_of(f, mesh);
	int order = pm_order_find(o->order ? o->order : law->order ? law->order : "2");
	int status = order < 0 ? -PM_USAGE : pm_operator_init(&t->operator, &g, PM_OP_LAP, order, t->density->components, false);
	return status ? status : contribute(o, f, law, t);
}

/* change += nu lap density */
static int add(struct pm_diffusion *t)
{
	const double *in[PM_COMPONENTS];
	double *out[PM_COMPONENTS];
	t->operator.add = t->change->nterms > 1;
	for (int c = 0; c < t->operator.in; c++) {
		in[c] = pm_in(t->density, c);
		out[c] = pm_out(t->change, c);
	}
	return pm_operator_apply(&t->operator, t->nu, in, out, NULL);
}

int pm_diffusion_add(struct pm_diffusion *t, struct pm_fft_plans *plans)
{
	if (plans->n > PM_FFT_PLANS - 3) /* frames of many sizes: empty the collection */
		pm_fft_plans_clear(plans);
	int status = pm_operator_plan(&t->operator, plans);
	if (!status)
		status = add(t);
	pm_limits_add(t->change, (struct pm_limits){.decay = t->nu * pm_operator_fastest(&t->operator)});
	return status;
}
