/* The law's density in, its rate of change out; the Laplacian is gradient.c's.
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
	*t = (struct pm_diffusion){.density = pm_reads(f, mesh->name, density), .nu = o->nu};
	if (!t->density)
		return -PM_DATA;
	struct pm_grid g = pm_grid_of(f, mesh);
	int order = pm_order_find(o->order ? o->order : law->order ? law->order : "2");
	int status = order < 0 ? -PM_USAGE : pm_operator_init(&t->operator, &g, PM_OP_LAP, order, t->density->components, false);
	return status ? status : contribute(o, f, own ? law->strength : o->field, t);
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
	return pm_operator_apply_planes(&t->operator, t->nu, t->density, in, out, NULL);
}

int pm_diffusion_add(struct pm_diffusion *t, struct pm_fft_plans *plans)
{
	if (plans->n > PM_FFT_PLANS - 3) /* frames of many sizes: empty the collection */
		pm_fft_plans_clear(plans);
	int status = pm_world_agree(pm_operator_plan(&t->operator, plans));
	if (!status)
		status = add(t);
	pm_limits_add(t->change, (struct pm_limits){.decay = t->nu * pm_operator_fastest(&t->operator)});
	return status;
}
