/* Eddy viscosities of a flow from its velocity gradient. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_VORTICITY_EDDY_VISCOSITY_H
#define PM_VORTICITY_EDDY_VISCOSITY_H

#include "mesh/grid.h"

enum pm_eddy_model { PM_EDDY_SMAGORINSKY, PM_EDDY_DYNAMIC, PM_EDDY_WALE, PM_EDDY_VREMAN, PM_EDDY_HYPER };
extern const char *const pm_eddy_names[]; /* in this order, NULL ends */

/* The factor of D^2 in nu_t that a coefficient means, C^2 or (vreman) c; NAN: the one published. Not of dynamic. */
double pm_eddy_factor(enum pm_eddy_model m, double coefficient);
/* out[n] = the model's rate, 1/time: nu_t is factor D^2 times it. a[i dim + j] = du_i/dx_j. dynamic and hyper: sqrt(2 S:S). */
void pm_eddy_rate(enum pm_eddy_model m, int dim, size_t n, const double *a, double *out);
/* The factor of the dynamic model, one number for the mesh; u[dim], a, rate as above, here: any field of the mesh. 0 or failure. */
int pm_eddy_dynamic(const struct pm_grid *g, const struct pm_field *here, const double *const u[3], const double *a, const double *rate, double *factor);

#endif
