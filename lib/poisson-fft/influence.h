/* Influence functions: the multiplier of each wave of the density in the transform solver, given the kernel of p2m and m2p and the gradient (influence.c;
 * docs/methods/pm-force.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_FFT_INFLUENCE_H
#define PM_POISSON_FFT_INFLUENCE_H

#include "kernel/kernel.h"
#include "mesh/grid.h"

PM_C_BEGIN

enum pm_influence_kind { PM_PLAIN, PM_DECONVOLVED, PM_OPTIMAL };
extern const char *const pm_influence_names[]; /* NULL ends */

struct pm_influence {
	enum pm_influence_kind kind;
	const struct pm_kernel *kernel; /* of p2m and m2p; not needed for plain */
	bool interlaced;                /* both on two meshes */
	int order;                      /* of the differences that make the field; 0 spectral; of optimal */
	double cloud;                   /* [length] diameter of the clouds S2 whose force is computed; 0: points */
	double (*factor)(double x);     /* set by the solver: of a softened Green's function (green/green.h), NULL none; x in units of 1/softening [length] */
	double softening;
};

static inline bool pm_influence_any(const struct pm_influence *f) { return f->kind != PM_PLAIN || f->cloud > 0; }
bool pm_influence_same(const struct pm_influence *a, const struct pm_influence *b);
int pm_influence_check(const struct pm_influence *f, const struct pm_grid *g); /* 0, or failure that names an alternative */

PM_C_END

#endif
