/* Free-space Green's functions of lap G - kappa^2 G = delta function at r > 0: 3-D -exp(-kappa r)/(4 pi r), 2-D -K0(kappa r)/(2 pi), 1-D
 * -exp(-kappa |x|)/(2 kappa); with kappa = 0: -1/(4 pi r), ln(r)/(2 pi), |x|/2. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_GREEN_PARTS_FREE_SPACE_H
#define PM_GREEN_PARTS_FREE_SPACE_H

#include <gsl/gsl_sf_bessel.h>

#include "green/green.h"

static inline double pm_green_free(int dim, double kappa, double r2)
{
	double x = kappa * sqrt(r2);
	if (dim == 3)
		return -exp(-x) / (4 * pm_pi * sqrt(r2));
	if (dim == 1)
		return kappa > 0 ? -exp(-x) / (2 * kappa) : 0.5 * sqrt(r2);
	if (kappa == 0)
		return log(r2) / (4 * pm_pi);
	return x > 700 ? 0 : -exp(-x) * gsl_sf_bessel_K0_scaled(x) / (2 * pm_pi); /* exp(-700): 1e-304 */
}

#endif
