/* Sums over a mesh, and over what a field is on, by the law of sums (base/in-order.h). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_MESH_SUM_H
#define PM_MESH_MESH_SUM_H

#include "base/in-order.h"
#include "mesh/grid.h"

/* The sum over all points of x, or of x y where y is not NULL, with the weights of quadrature. */
double pm_grid_sum(const struct pm_grid *g, const double *x, const double *y);
/* The same of values of a field, over all ranks where it is divided: they call it in the same order, and one that cannot go on ends the run. */
double pm_grid_sum_of(const struct pm_grid *g, const struct pm_field *field, const double *x, const double *y);
/* pm_over_mesh of base/in-order.h in the same way, with the values here; rows before the first of these: pm_grid_rows_before. */
void pm_grid_over(const struct pm_grid *g, const struct pm_field *field, const struct pm_parts *p, const void *data, void *all);
size_t pm_grid_rows_before(const struct pm_grid *g, const struct pm_field *field);
/* Parts over the values of a field of the frame, on a set or on a mesh; of all ranks where it is divided, each with the values here. */
void pm_over_field(const struct pm_parts *p, const void *data, const struct pm_frame *f, const struct pm_field *field, void *all);

#endif
