/* Another geometry for a mesh: derived and change fields go, uniform fields stay, other state is refused because nobody said how to carry it over.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/regrid.h"

/* Uniform values that somebody has expanded are expanded again on the new points. */
static int resize(struct pm_field *field, size_t count)
{
	int status = pm_field_resize(field, count);
	if (status || !pm_field_bytes(field))
		return status;
	for (int c = 0; c < field->components; c++)
		for (size_t i = 0; i < count; i++)
			if (field->type == PM_I64)
				pm_out_i64(field, c)[i] = (int64_t)field->value[c];
			else if (field->type == PM_U8)
				pm_out_u8(field, c)[i] = (unsigned char)field->value[c];
			else
				pm_out(field, c)[i] = field->value[c];
	return 0;
}

static int carry_over(struct pm_frame *f, const struct pm_mesh *m, struct pm_field *field)
{
	size_t points[3];
	if (strcmp(field->on, m->name))
		return 0;
	if (!field->uniform)
		return pm_fail(PM_DATA, "mesh '%s' carries the %s '%s', which cannot be put on other points (only uniform fields can; drop it with sel)",
			m->name, pm_role_names[field->role], field->name);
	return resize(field, pm_mesh_points(f, m, points));
}

int pm_mesh_regrid(struct pm_frame *f, struct pm_mesh *m, const size_t cells[3], const double lo[3], const double h[3])
{
	int status = 0;
	for (int d = 0; d < f->dim; d++) {
		m->cells[d] = cells[d];
		m->lo[d] = lo[d];
		m->h[d] = h[d];
	}
	pm_drops_roles(f, m->name, 1u << PM_DERIVED | 1u << PM_CHANGE);
	for (size_t i = 0; i < f->nfields && !status; i++)
		status = carry_over(f, m, f->fields[i]);
	return status;
}

int pm_mesh_regrid_box(struct pm_frame *f, struct pm_mesh *m, const size_t cells[3])
{
	double h[3];
	for (int d = 0; d < f->dim; d++)
		h[d] = (f->hi[d] - f->lo[d]) / (double)cells[d];
	return pm_mesh_regrid(f, m, cells, f->lo, h);
}
