/* Another geometry for a mesh of a frame.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_REGRID_H
#define PM_MESH_REGRID_H

#include "stream/frame.h"

/* Gives the mesh these cells, origin and spacing [length]. Its derived and change fields are dropped (they belong to the old points), uniform
 * fields are carried over; any other state is refused with a message. For plan, or for frame() under PM_HOLD. */
int pm_mesh_regrid(struct pm_frame *f, struct pm_mesh *m, const size_t cells[3], const double lo[3], const double h[3]);
/* The same over the whole box. */
int pm_mesh_regrid_box(struct pm_frame *f, struct pm_mesh *m, const size_t cells[3]);

#endif
