/* A given field from a file: acc_p += (q/m)_p sum over points of W((x_p - x_i)/h) E_i, and bfield_p += the same of B, with the mesh, the spacing and the
 * faces of the frame in the file, whatever those of the run are. Values beyond a face are those inside it (periodic, or the mirror image of the same sign).
 * Error of cic: h^2/8 times the second derivative. Source: Hockney and Eastwood 1988, section 5-3. Cost: one gather of each field;
 * every rank has the whole mesh of the file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "stream/declare.h"
#include "transfer/field-of-file.h"
#include "world/world.h"

static const struct pm_field *found(const struct pm_frame *from, const char *name)
{
	const struct pm_field *field = NULL;
	for (size_t i = 0; i < from->nmeshes && name && !field; i++)
		field = pm_frame_field(from, from->meshes[i]->name, name);
	return field;
}

static int sets_of(const struct pm_file_field *c, const struct pm_frame *f, const struct pm_law *law, struct pm_sets *sets)
{
	const char *const needs[] = {"x", law->of, law->per, law->per ? law->strength : NULL, NULL};
	return pm_sets_choose(f, c->set, needs, "stab reads it from a table", sets);
}

static int declare_on(const struct pm_file_field *c, struct pm_frame *f, const struct pm_law *law, const char *set)
{
	const struct pm_field *field = found(c->from, law->field), *magnetic = found(c->from, law->magnetic);
	if (!pm_reads(f, set, "x") || (law->per && (!pm_reads(f, set, law->strength) || !pm_reads(f, set, law->per))))
		return -PM_DATA;
	const int components = field ? field->components : f->dim;
	if (!pm_contributes(f, set, law->change, law->of, components, c->term, c->replace)) /* of a magnetic field alone 0, which a kick needs */
		return -PM_DATA;
	return magnetic && !pm_contributes(f, set, "bfield", "", 3, c->term, c->replace) ? -PM_DATA : 0;
}

int pm_file_field_declare(const struct pm_file_field *c, struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	struct pm_sets sets;
	if (!law)
		return -PM_DATA;
	const struct pm_field *field = found(c->from, law->field), *magnetic = found(c->from, law->magnetic);
	if (!field && !magnetic)
		return pm_fail(PM_DATA, "%s: no mesh has the law's field '%s'%s (sls lists the fields)", c->path, law->field ? law->field : "",
			law->magnetic ? ", nor a magnetic one" : "");
	if (c->from->dim != f->dim)
		return pm_fail(PM_DATA, "%s has %d dimensions, and this frame %d", c->path, c->from->dim, f->dim);
	if (magnetic && magnetic->components != 3)
		return pm_fail(PM_DATA, "%s: '%s' has %d components, and a magnetic field has 3", c->path, law->magnetic, magnetic->components);
	int status = sets_of(c, f, law, &sets);
	for (size_t i = 0; i < sets.n && !status; i++)
		status = declare_on(c, f, law, sets.name[i]);
	return status;
}

/* field at the particles of the set, times the factor (NULL: 1), added to *to. */
static int add(const struct pm_file_field *c, const struct pm_frame *f, const char *set, const struct pm_field *field, const double *factor,
	struct pm_field *to)
{
	const struct pm_mesh *m = pm_frame_mesh(c->from, field->on);
	struct pm_transfer t = {.grid = pm_grid_of(c->from, m), .kernel = pm_kernel_find(c->kernel ? c->kernel : "cic"), .components = field->components};
	const double *x[3] = {0}, *mesh[PM_COMPONENTS], *factors[PM_COMPONENTS];
	double *out[PM_COMPONENTS];
	struct pm_strays strays = {.count = 0};
	if (!t.kernel) /* on all ranks */
		return -PM_DATA;
	pm_grid_even(&t.grid);
	memcpy(t.staggered, field->staggered, sizeof t.staggered);
	for (int d = 0; d < f->dim; d++)
		x[d] = pm_in(pm_frame_field(f, set, "x"), d);
	for (int k = 0; k < field->components; k++)
		mesh[k] = pm_in(field, k), factors[k] = factor, out[k] = pm_out(to, k);
	int status = pm_gather(&t, to->count, x, mesh, factors, out, &strays);
	strays.first += to->first;
	if (!status && strays.count)
		status = pm_strays_refuse(&strays, set, m, &t, "the mesh of --file must contain all particles");
	return pm_world_agree(status);
}

static int add_to(const struct pm_file_field *c, struct pm_frame *f, const struct pm_law *law, const char *set)
{
	const struct pm_field *field = found(c->from, law->field), *magnetic = found(c->from, law->magnetic);
	const double *ratio = NULL;
	double *made = NULL;
	int status = pm_world_agree(field && law->per ? pm_ratio(f, set, law->strength, law->per, &ratio, &made) : 0);
	if (!status && field)
		status = add(c, f, set, field, ratio, pm_frame_field(f, set, law->change));
	pm_free(made);
	return !status && magnetic ? add(c, f, set, magnetic, NULL, pm_frame_field(f, set, "bfield")) : status;
}

int pm_file_field_add(const struct pm_file_field *c, struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	struct pm_sets sets;
	int status = sets_of(c, f, law, &sets);
	for (size_t i = 0; i < sets.n && !status; i++)
		status = add_to(c, f, law, sets.name[i]);
	return status;
}
