/* cycle does not write what mgrad makes of the potential (docs/methods/mgrad.md). The same differences of the same potential give the same bits. Where nobody
 * states their order, it is the law's. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "fft/fftw-plan.h"
#include "measure/law-field.h"
#include "mesh/gradient-frame.h"
#include "stream/declare.h"
#include "stream/parts.h"
#include "world/world.h"

static const struct pm_field *on(const struct pm_frame *f, const struct pm_mesh *mesh, const char *name)
{
	return mesh && name ? pm_frame_field(f, mesh->name, name) : NULL;
}

const struct pm_mesh *pm_law_field_mesh(const struct pm_measure *how, const struct pm_frame *f)
{
	const struct pm_mesh *solved = NULL;
	for (size_t i = 0; how->field && i < f->nmeshes; i++) {
		const struct pm_field *phi = on(f, f->meshes[i], how->potential);
		if (on(f, f->meshes[i], how->field) || (phi && pm_gradient_order_of(phi)))
			return f->meshes[i];
		solved = solved || !phi ? solved : f->meshes[i];
	}
	return solved;
}

void pm_law_field_reads(const struct pm_measure *how, struct pm_frame *f)
{
	const struct pm_mesh *mesh = pm_law_field_mesh(how, f);
	if (mesh)
		pm_reads(f, mesh->name, on(f, mesh, how->field) ? how->field : how->potential);
}

/* Of a potential that ranks share they share the field. */
static int make(struct pm_frame *f, const struct pm_mesh *mesh, const struct pm_field *phi, const struct pm_field **field, uint64_t **from)
{
	struct pm_gradient t;
	struct pm_fft_plans plans = {0};
	const struct pm_gradient_choice choice = {.order = pm_gradient_order_of(phi), .mesh = mesh->name};
	const bool shared = phi->here;
	if (pm_gradient_declare(&choice, f, &t)) /* a mesh too small for these differences: cannot be computed */
		return 0;
	int status = shared ? pm_field_share(t.target, pm_division_grain(f, mesh->name)) : pm_field_ready((struct pm_field *)t.source);
	*from = (uint64_t *)(uintptr_t)t.target->from;
	status = status ? status : pm_field_ready(t.target);
	status = status ? status : pm_gradient_plan(&t, &plans);
	status = shared ? pm_world_agree(status) : status;
	status = status ? status : pm_gradient_apply(&t);
	pm_fft_plans_clear(&plans);
	*field = status ? NULL : t.target;
	return status;
}

int pm_law_field_of(const struct pm_measure *how, const struct pm_frame *f, struct pm_law_field *e)
{
	const struct pm_mesh *mesh = pm_law_field_mesh(how, f);
	const struct pm_field *phi = on(f, mesh, how->potential);
	*e = (struct pm_law_field){.field = on(f, mesh, how->field)};
	if (e->field || !phi)
		return 0;
	if (!(e->made = pm_frame_copy(f)))
		return pm_failed();
	return make(e->made, pm_frame_mesh(e->made, mesh->name), pm_frame_field(e->made, mesh->name, how->potential), &e->field, &e->from);
}

void pm_law_field_free(struct pm_law_field *e)
{
	e->made = pm_frame_free(e->made);
	free(e->from);
	e->from = NULL;
}
