/* What a remeshing needs before it begins: a cut-off and a rim where none were chosen, and a mesh that holds every particle.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "remesh/remesh-frame.h"

/* Can strength spread to the edge of the mesh? Then a few nodes of next to no strength would be added at every remeshing, without an end. */
static bool open_faces(const struct pm_frame *f)
{
	for (int k = 0; k < 2 * f->dim; k++)
		if (f->face[k / 2][k % 2] == PM_OPEN || f->face[k / 2][k % 2] == PM_ABSORBING)
			return true;
	return false;
}

void pm_remesh_defaults(const struct pm_frame *f, struct pm_remesh_choice *c)
{
	const bool open = open_faces(f), spreads = open && !c->by && pm_frame_constant(f, "nu", 0) > 0;
	if (isnan(c->cut_off))
		c->cut_off = open ? 1e-6 : 0;
	if (c->rim < 0)
		c->rim = spreads ? 2 : 0;
}

int pm_remesh_grow(struct pm_frame *f, struct pm_mesh *m, const struct pm_kernel *kernel, const struct pm_sets *sets)
{
	struct pm_kernel wide = *kernel;
	const struct pm_transfer t = {.grid = pm_grid_of(f, m), .kernel = &wide};
	wide.width += 2 * (int)pm_remesh_room(kernel); /* the new particles have room to move, too */
	const int status = pm_mesh_grow(f, m, &t, sets);
	return status < 0 ? status : 0;
}
