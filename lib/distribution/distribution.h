/* Velocity distributions by name: one file each, chosen by species --distribution (docs/methods/species.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_DISTRIBUTION_H
#define PM_DISTRIBUTION_H

#include "base/base.h"

enum { PM_DISTRIBUTION_NUMBERS = 4 };

struct pm_distribution_choice {
	int velocities;                     /* components of v, 1..3 */
	double vth[3], drift[3];            /* [length/time] standard deviation of each component (juettner: sqrt(T/m)); mean */
	double kappa, ring;                 /* [1], [length/time] */
	double c;                           /* [length/time] speed of light; 0: the frame has none */
};

struct pm_distribution {
	const char *name, *sentence, *source;
	int least;                          /* components of v that it needs */
	bool isotropic;                     /* one vth for all components */
	int numbers[4];                     /* uniform numbers that draw takes for 1, 2, 3 components, index 0 unused */
	/* 0, or failure where the choice has no such distribution. May be NULL. */
	int (*check)(const struct pm_distribution_choice *c);
	/* A quantity r whose density up to a factor is radial(r) in range[0]..range[1], drawn by inversion; NULL: none. */
	double (*radial)(const struct pm_distribution_choice *c, double r);
	void (*range)(const struct pm_distribution_choice *c, double range[2]);
	/* v from r and uniform numbers 0 < u < 1. */
	void (*draw)(const struct pm_distribution_choice *c, double r, const double *u, double *v);
};

extern const struct pm_distribution *const pm_distributions[]; /* generated from lib/distribution/, NULL ends */
extern const char *const pm_distribution_names[];
const struct pm_distribution *pm_distribution_find(const char *name); /* NULL with a message */

#endif
