/* Green's functions of open space: lap G - kappa^2 G = delta function over the open axes of a mesh, as the solvers by transforms use them. One file per
 * method. kappa^2 comes from the waves along the other axes and from the screened equation. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_GREEN_H
#define PM_GREEN_H

#include "base/base.h"

PM_C_BEGIN

struct pm_green_case {
	int dim;              /* open axes, 1 to 3 */
	double h[3];          /* [length] spacing of the open axes */
	double kappa;         /* [1/length] */
	double k2;            /* [1/length^2] of the waves along the other axes alone: kappa^2 without the screened equation's part */
	double reach;         /* [length] transforms are of the function cut off beyond this distance */
	double width;         /* [length] standard deviation of the blobs that regularise, where the method has them */
	double constant[4];   /* of the method, by prepare */
};

struct pm_green {
	const char *name, *sentence, *source;
	int order;                 /* of the potential of a smooth source in the spacing; 0: beyond every power; of differences: of fd2 */
	unsigned plain, screened;  /* bits 1u<<dim: open axes it is for with kappa = 0, with kappa > 0 */
	bool regular;              /* has a width */
	bool differences;          /* the inverse of the differences of --symbol, else of the Laplacian; its at is for one axis and fd2 */
	/* At least one of two: at, the value at distance sqrt(r2), at r2 = 0 what the sum over nodes takes there; transform, of the function cut off
	 * at reach, at wave number sqrt(k2), which is taken where at is missing or some kappa > 0. */
	double (*at)(const struct pm_green_case *c, double r2);
	double (*transform)(const struct pm_green_case *c, double k2);
	void (*prepare)(struct pm_green_case *c); /* may be NULL; fills constant */
};

extern const struct pm_green *const pm_greens[]; /* generated from lib/green/, NULL ends */
extern const char *const pm_green_names[];
const struct pm_green *pm_green_find(const char *name); /* NULL with a message */

PM_C_END

#endif
