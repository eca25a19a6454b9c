/* The options of the words that put particles on a mesh (p2m, remesh): which mesh, and how many cells it is to have.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_MESH_OPTIONS_H
#define PM_STAGE_MESH_OPTIONS_H

#include "stage/stage.h"

/* Rows of options, for a struct config with the members `struct pm_cells cells` and `const char *mesh`. */
#define PM_MESH_ROWS \
	{.name = "cells", .letter = 'n', .kind = PM_CELLS, .unit = "cells", .low = 1, .high = 1 << 24, PM_AT(cells), \
		.text = "give the mesh this many cells over the box, 64 or 64x32x32"}, \
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh (default: the first)"}

/* Gives the mesh the cells that were typed, if any: 1 where that changed it, 0 where it stays, or failure. */
int pm_mesh_take_cells(struct pm_frame *f, struct pm_mesh *m, const struct pm_cells *typed);
/* The same where the mesh may not be there yet (*m NULL): then it is made, with this name ("mesh" for NULL). 0 or failure. */
int pm_mesh_take_or_make(struct pm_frame *f, struct pm_mesh **m, const struct pm_cells *typed, const char *name);

#endif
