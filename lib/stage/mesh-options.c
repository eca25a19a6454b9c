/* A mesh with as many cells as were typed, over the whole box. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/regrid.h"
#include "stage/mesh-options.h"

int pm_mesh_take_cells(struct pm_frame *f, struct pm_mesh *m, const struct pm_cells *typed)
{
	size_t cells[3] = {1, 1, 1};
	int status = typed->n ? pm_cells_for(typed, f->dim, cells) : 0;
	if (status || !typed->n || !memcmp(cells, m->cells, sizeof cells))
		return status;
	status = pm_mesh_regrid_box(f, m, cells);
	return status ? status : 1;
}

int pm_mesh_take_or_make(struct pm_frame *f, struct pm_mesh **m, const struct pm_cells *typed, const char *name)
{
	size_t cells[3] = {1, 1, 1};
	int status = 0;
	if (*m || !typed->n)
		status = typed->n ? pm_mesh_take_cells(f, *m, typed) : 0;
	else if (!(status = pm_cells_for(typed, f->dim, cells)))
		status = (*m = pm_frame_mesh_new(f, name ? name : "mesh", cells)) ? 0 : -PM_DATA;
	return status < 0 ? status : 0;
}
