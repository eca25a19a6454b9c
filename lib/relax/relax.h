/* Iterative methods for lap u = f on the nodes of a mesh: one file per method, chosen by name (docs/methods/poisson-relax.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_RELAX_H
#define PM_RELAX_H

#include "mesh/laplacian.h"

enum { PM_RELAX_EXTRA = 4 };

/* What a method works on; the driver (lib/poisson-relax/relaxation.c) owns it. */
struct pm_relax_work {
	const struct pm_laplacian *lap;
	double *u;                     /* the iterate; a method may swap it with one of its own meshes */
	const double *f;
	double factor;                 /* of relaxation */
	bool fresh;                    /* u was changed outside, so that the method's stored vectors are invalid; the method sets it to false */
	double *extra[PM_RELAX_EXTRA]; /* meshes, zero at the start; stay 0 at nodes where u is not an unknown */
	double *sums;                  /* per row */
	double memory;                 /* one number kept from sweep to sweep */
};

struct pm_relax {
	const char *name, *sentence, *source;
	bool bound;                    /* radius is only a bound, and sweeps depend on earlier ones: conjugate gradients */
	bool in_planes;                /* no order of the nodes beyond colours: ranks can share it, each with its planes */
	int extra;                     /* meshes it needs besides u and f */
	double (*factor)(const struct pm_laplacian *l); /* its own relaxation factor; NULL: it has none */
	/* Spectral radius: the asymptotic error reduction per sweep by the published formula; NAN if that does not apply. 1 or more: no convergence. */
	double (*radius)(const struct pm_laplacian *l, double factor);
	/* One sweep. Returns the weighted sum of squares of the residual: of the old u, or of each node just before its update; for conjugate gradients
	 * of the new u. */
	double (*sweep)(struct pm_relax_work *w);
};

extern const struct pm_relax *const pm_relaxs[]; /* generated from lib/relax/, NULL ends */
extern const char *const pm_relax_names[];
const struct pm_relax *pm_relax_find(const char *name); /* NULL with a message */

#endif
