/* Mollifiers: how a point source is smoothed in a direct sum, as the factor q(s), s = r/delta, on the bare force of a point, and the pair
 * potential. One file per mollifier. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MOLLIFIER_H
#define PM_MOLLIFIER_H

#include "base/base.h"

struct pm_mollifier {
	const char *name, *sentence, *source;
	unsigned dims; /* bit 1u<<dim */
	/* force(r2, delta, dim): f such that the field of a unit strength (lap phi = delta function) at displacement x from it is -f*x, r2 = |x|^2;
	 * 0 at r = 0. potential: phi of it, lap phi = delta function smeared; finite at r = 0 if delta > 0. */
	double (*force)(double r2, double delta, int dim);
	double (*potential)(double r2, double delta, int dim);
	int order; /* of the error against the bare kernel away from the source, in delta; 0: exact beyond delta */
};

extern const struct pm_mollifier *const pm_mollifiers[]; /* generated from lib/mollifier/, NULL ends */
extern const char *const pm_mollifier_names[];
const struct pm_mollifier *pm_mollifier_find(const char *name); /* NULL with a message */

#endif
