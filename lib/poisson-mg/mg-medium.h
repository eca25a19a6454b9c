/* The medium between the nodes as the differences of multigrid have it, for its boundary values. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_MG_MG_MEDIUM_H
#define PM_POISSON_MG_MG_MEDIUM_H

#include "poisson-mg/mg-variable.h"
#include "poisson/boundary.h"

static inline double pm_mg_harmonic(double a, double b) { return pm_mg_face(PM_MG_HARMONIC, a, b); }
static inline double pm_mg_arithmetic(double a, double b) { return pm_mg_face(PM_MG_ARITHMETIC, a, b); }
static inline struct pm_boundary_eps pm_mg_medium(const double *eps, enum pm_mg_mean mean)
{
	return (struct pm_boundary_eps){eps, mean == PM_MG_HARMONIC ? pm_mg_harmonic : pm_mg_arithmetic};
}

#endif
