/* How far a set has gone from its shadow: the same particles, started a little apart. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_SEPARATION_H
#define PM_MEASURE_SEPARATION_H

#include "stream/frame.h"

/* In declare(): both sets exist, have equally many particles, and positions; declares the reads. 0 or failure. */
int pm_separation_reads(struct pm_frame *f, const char *const sets[2]);
/* apart[0] [length]: root of the mean square distance of a particle from the one at its place in the other set, the nearest image in a periodic box;
 * apart[1] [length/time]: the same of the velocities, NAN without. Sums are compensated. Failure where ids show that the orders differ. */
int pm_separation_of(const struct pm_frame *f, const char *const sets[2], double apart[2]);

struct pm_divergence {
	double lambda, error; /* [1/time] slope of ln d and its standard error; NAN: too few points */
	double from, to;      /* [time] of the points used */
	size_t points;
};
/* Fits ln d = lambda t + c to n values d at times t, ascending, between from and to (NAN: from the first, until d is a hundredth of its largest value). */
struct pm_divergence pm_divergence_of(size_t n, const double *t, const double *d, double from, double to);

#endif
