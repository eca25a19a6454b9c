/* Iterative methods for lap u = f on the nodes of a mesh: one file per method, chosen by name (docs/methods/poisson-relax.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_RELAX_H
#define PM_RELAX_H

#include "mesh/laplacian.h"

enum { PM_RELAX_EXTRA = 4 };

/* What a method works on; the driver (lib/poisson-relax/relaxation.c) owns it. */
struct pm_relax_work {
	const struct pm_laplacian *lap;
	double *u;                     /* the iterate; a method may exchange it with a mesh of its own */
	const double *f;
	double factor;                 /* of relaxation */
	bool fresh;                    /* u was changed outside, so that the method's stored vectors are invalid; the method sets it to false */
	double *extra[PM_RELAX_EXTRA]; /* meshes, zero at the start; nothing but 0 is written where u is no unknown */
	double *sums;                  /* per row */
	double memory;                 /* one number kept from sweep to sweep */
};

struct pm_relax {
	const char *name, *sentence, *source;
	bool bound;                    /* radius is a bound, and the method remembers from sweep to sweep: conjugate gradients */
	int extra;                     /* meshes it needs besides u and f */
	double (*factor)(const struct pm_laplacian *l); /* its own relaxation factor; NULL: it has none */
	/* By how much it shrinks the error per sweep in the long run, the published formula; NAN where that does not hold. 1 or more: it does not converge. */
	double (*radius)(const struct pm_laplacian *l, double factor);
	/* One sweep. Returns the weighted sum of squares of the residual: of the old u, or of each node when its turn came; conjugate gradients return that
	 * of the new u. */
	double (*sweep)(struct pm_relax_work *w);
};

extern const struct pm_relax *const pm_relaxs[]; /* generated from lib/relax/, NULL ends */
extern const char *const pm_relax_names[];
const struct pm_relax *pm_relax_find(const char *name); /* NULL with a message */

#endif
