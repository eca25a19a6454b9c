/* Another geometry for a mesh: derived and change fields are dropped, uniform fields are kept, other state is an error, because there is no rule to
 * interpolate it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "mesh/regrid.h"
#include "stream/declare.h"

int pm_mesh_regrid(struct pm_frame *f, struct pm_mesh *m, const size_t cells[3], const double lo[3], const double h[3])
{
	for (int d = 0; d < f->dim; d++) {
		m->cells[d] = cells[d];
		m->lo[d] = lo[d];
		m->h[d] = h[d];
	}
	pm_drops_roles(f, m->name, 1u << PM_DERIVED | 1u << PM_CHANGE);
	return pm_frame_mesh_resize(f, m);
}

int pm_mesh_regrid_box(struct pm_frame *f, struct pm_mesh *m, const size_t cells[3])
{
	double h[3];
	for (int d = 0; d < f->dim; d++)
		h[d] = (f->hi[d] - f->lo[d]) / (double)cells[d];
	return pm_mesh_regrid(f, m, cells, f->lo, h);
}
