/* Discretisation-corrected particle strength exchange (docs/methods/pse.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_NEAR_DCPSE_H
#define PM_NEAR_DCPSE_H

#include "cell/cell-list.h"

enum { PM_DC_MOMENTS = 119, PM_DC_FIELDS = 16 }; /* monomials of degree 1..7 in 3-D; fields at a time */

struct pm_dc {
	int dim, order; /* 1, 2, 3; 2, 4 or 6 */
	int power[3];   /* the derivative, of degree 1 to 4: times each axis; all 0: the Laplacian, whose degree is 2. Degree + order - 1 is at most 7 */
	int axis, side; /* partners on one side alone: side -1 those below along axis (x_q <= x_p), +1 those above; 0 both */
	double eps;     /* [length] the window is exp(-(r/eps)^2) */
	const uint64_t *here; /* [2] the first particle that is wanted, and the one behind the last; NULL: all. Rates are of these alone */
	double reach;   /* [length] partners are no farther, unless they do not determine the moments well: then up to the reach of the cell list */
};

struct pm_dc_found {
	double fastest;  /* no mode of the operator is larger [1/length^degree]: its largest row sum */
	uint64_t widened; /* particles that needed partners beyond the cut-off */
	size_t stuck;    /* the first particle whose partners do not determine the derivative; SIZE_MAX none */
	size_t partners; /* of it */
	int rank, wanted;
};

double pm_dc_cutoff(int order); /* the default reach, in eps */
static const double pm_dc_widest = 2; /* reach of the cell list over reach */

/* rate[f][p] (p counted from the first wanted) += nu times the derivative of value[f] at p, from the values of its partners and their images. PM_NUMERICS
 * (without a message) where found->stuck is one. The same bytes for any number of threads. */
int pm_dc_add(const struct pm_dc *o, const struct pm_cell_list *l, double nu, int fields, const double *const value[], double *const rate[],
	struct pm_dc_found *found);

#endif
