/* How well a potential and its field obey their equations. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_FIELD_H
#define PM_MEASURE_FIELD_H

#include "measure/measure.h"
#include "mesh/grid.h"

/* In declare(). 0, or failure where the box of the flux is not inside the mesh. */
int pm_field_reads(const struct pm_measure *how, struct pm_frame *f);
/* Is there a mesh with density and potential? */
bool pm_field_known(const struct pm_measure *how, const struct pm_frame *f);
/* In the order of enum pm_field_column; NAN without potential and density on a mesh. 0, or failure without memory. */
int pm_field_of(const struct pm_measure *how, const struct pm_frame *f, double value[PM_FIELD_COLUMNS]);

/* The nodes of the box of the flux along an axis: first <= i < end. */
void pm_flux_nodes(const struct pm_measure *how, const struct pm_grid *g, int d, size_t *first, size_t *end);
/* measure-poynting.c: of Yee's E and B, the power that leaves the box, and the energy in it. 0 or failure. */
int pm_poynting_of(const struct pm_measure *how, const struct pm_grid *g, const struct pm_field *e, const struct pm_field *b, double *flux, double *inside);

#endif
