/* Green's functions of open space: lap G - kappa^2 G = delta function over the open axes of a mesh, for the solvers that use transforms. One file per
 * method. kappa^2 comes from the waves along the other axes and from the screened equation. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_GREEN_H
#define PM_GREEN_H

#include "base/base.h"

PM_C_BEGIN

struct pm_green_case {
	int dim;              /* open axes, 1 to 3 */
	double h[3];          /* [length] spacing of the open axes */
	double kappa;         /* [1/length] */
	double k2;            /* [1/length^2] squared wave number along the other axes: kappa^2 without the part of the screened equation */
	double reach;         /* [length] the function is truncated (set to 0) beyond this distance before it is transformed */
	double width;         /* [length] standard deviation of the regularising blobs, if the method has them; of softened functions the softening */
	double constant[4];   /* numbers of the method's own, set by prepare */
};

struct pm_green {
	const char *name, *sentence, *source;
	int order;                 /* order in h of the potential of a smooth source; 0: faster than every power; for an inverse of differences: with fd2 */
	unsigned plain, screened;  /* bits 1u<<(number of open axes): supported with kappa = 0, with kappa > 0 */
	bool regular;              /* it depends on width */
	bool differences;          /* it inverts the differences of --symbol, not the Laplacian; its `at` is for one axis and fd2 */
	/* At least one of two. at: the value at distance sqrt(r2); at r2 = 0 the value used in the sum over nodes. transform: that of the function truncated at
	 * reach, at wave number sqrt(k2); used if `at` is missing, or some kappa > 0 and it is smooth: 0 to round-off at the Nyquist wave of the mesh. */
	double (*at)(const struct pm_green_case *c, double r2);
	double (*transform)(const struct pm_green_case *c, double k2);
	bool (*smooth)(const struct pm_green_case *c); /* of those that have both */
	/* Of softened functions: what multiplies the transform of the function of a point, at x = wave number times width. Periodic faces and walls take it
	 * too, and width is the softening itself, 0 for none. NULL: for open faces alone, and width is a standard deviation. */
	double (*factor)(double x);
	void (*prepare)(struct pm_green_case *c); /* may be NULL; fills constant */
};

extern const struct pm_green *const pm_greens[]; /* generated from lib/green/, NULL ends */
extern const char *const pm_green_names[];
const struct pm_green *pm_green_find(const char *name); /* NULL with a message */

PM_C_END

#endif
