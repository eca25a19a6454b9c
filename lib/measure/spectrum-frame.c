/* The field of a frame whose spectrum is wanted, and its table. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "fft/fftw-plan.h"
#include "law/law.h"
#include "measure/law-field.h"
#include "measure/spectrum-frame.h"
#include "stream/declare.h"

static struct pm_measure law_of(const struct pm_law *law) { return (struct pm_measure){.field = law->field, .potential = law->potential}; }

/* The velocity of vortices, else the density: those that are asked for most. */
static const char *usual(const struct pm_law *law)
{
	return law->of_potential == PM_CURL && law->field ? law->field : law->density;
}

int pm_spectrum_declare(const struct pm_spectrum_choice *c, struct pm_frame *f, struct pm_spectrum_source *from)
{
	const struct pm_law *law = pm_law_of(f);
	if (!law)
		return -PM_DATA;
	const struct pm_measure how = law_of(law);
	from->name = c->field ? c->field : usual(law);
	from->mesh = NULL;
	if (!from->name)
		return pm_fail(PM_DATA, "the law '%s' has no field that is meant (--field NAME)", f->law);
	for (size_t i = f->nmeshes; i-- > 0;)
		if (pm_frame_field(f, f->meshes[i]->name, from->name) && (!c->mesh || !strcmp(c->mesh, f->meshes[i]->name)))
			from->mesh = f->meshes[i];
	const struct pm_mesh *solved = pm_law_field_mesh(&how, f);
	from->made = !from->mesh && how.field && !strcmp(from->name, how.field) && solved && (!c->mesh || !strcmp(c->mesh, solved->name));
	if (from->made)
		from->mesh = solved;
	if (!from->mesh)
		return pm_fail(PM_DATA, "no field '%s' on %s%s (sls lists them; p2m, the solvers and mgrad make them)", from->name,
			c->mesh ? "the mesh " : "a mesh", c->mesh ? c->mesh : "");
	if (from->made)
		pm_law_field_reads(&how, f);
	else
		pm_reads(f, from->mesh->name, from->name);
	return 0;
}

int pm_spectrum_frame(const struct pm_spectrum_choice *c, const struct pm_frame *f, const struct pm_spectrum_source *from, struct pm_fft_plans *plans,
	const struct pm_spectrum_print *print)
{
	struct pm_spectrum_print how_to = *print;
	const struct pm_measure how = law_of(pm_law_of(f));
	const struct pm_grid g = pm_grid_of(f, from->mesh);
	struct pm_law_field made = {0};
	struct pm_spectrum spectrum = {0};
	int status = from->made ? pm_law_field_of(&how, f, &made) : 0;
	const struct pm_field *field = from->made ? made.field : pm_frame_field(f, from->mesh->name, from->name);
	if (!status && !field)
		status = pm_fail(PM_DATA, "'%s' cannot be made of its potential on '%s' (a mesh too small for the differences)", from->name,
			from->mesh->name);
	if (!status && field->type != PM_F64 && field->type != PM_F32)
		status = pm_fail(PM_DATA, "'%s' is not a field of real numbers", from->name);
	if (!status)
		status = pm_spectrum_of(&g, field, c->shell, plans, &spectrum);
	if (!status && c->contrast && !(field->components == 1 && fabs(spectrum.mean[0]) > 0))
		status = pm_fail(PM_DATA, "--contrast divides by the mean, and '%s' %s", from->name,
			field->components == 1 ? "has the mean 0" : "is a vector");
	how_to.scale = c->contrast ? spectrum.mean[0] : 1, how_to.dim = f->dim, how_to.time = f->time;
	if (!status)
		status = pm_spectrum_write(&spectrum, from->name, field->components, &how_to);
	pm_spectrum_free(&spectrum);
	pm_law_field_free(&made);
	return status;
}
