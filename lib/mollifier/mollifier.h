/* Mollifiers: how a point source is smoothed in a direct sum, as a factor q(s), s = r/delta, that multiplies the bare force of a point, and the pair
 * potential. One file per mollifier. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MOLLIFIER_H
#define PM_MOLLIFIER_H

#include "base/base.h"

PM_C_BEGIN

struct pm_mollifier {
	const char *name, *sentence, *source;
	unsigned dims; /* bit 1u<<dim */
	/* force(r2, delta, dim): f such that the gradient of the potential of a unit strength (lap phi = delta function) at displacement x from
	 * it is f*x, r2 = |x|^2; finite unless r2 and delta are both 0. potential: phi, lap phi = the blob; finite in the same cases, and equal to the bare
	 * potential far away. Bare: f = 1/(2r), 1/(2 pi r^2), 1/(4 pi r^3); phi = r/2, ln(r)/(2 pi), -1/(4 pi r) in 1-D, 2-D, 3-D. */
	double (*force)(double r2, double delta, int dim);
	double (*potential)(double r2, double delta, int dim);
	/* In 3-D: 2 df/d(r2) = f'(r)/r, by which the velocity gradient of a vortex is smoothed; bare -3/(4 pi r^5). NULL where it is not defined in 3-D. */
	double (*slope)(double r2, double delta);
	int order;    /* power of delta/r in force/bare - 1 far away; 0: exact for r >= reach*delta */
	double reach; /* beyond reach*delta it equals the bare kernel to round-off; 0: nowhere */
	bool square;  /* force and potential are the bare ones at r2 + delta^2; the fast loops use this */
	bool bare;    /* delta is not used */
	/* How the fast loops over vectors evaluate others (far/vortex-pairs.h). */
	enum pm_mollifier_loop { PM_LOOP_OWN, PM_LOOP_GAUSSIAN, PM_LOOP_GAUSSIAN_4, PM_LOOP_ALGEBRAIC } loop;
};

extern const struct pm_mollifier *const pm_mollifiers[]; /* generated from lib/mollifier/, NULL ends */
extern const char *const pm_mollifier_names[];
const struct pm_mollifier *pm_mollifier_find(const char *name); /* NULL with a message */

PM_C_END

#endif
