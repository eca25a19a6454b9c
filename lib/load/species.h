/* A species: a set of particles drawn from a density and a distribution of velocities, what the word species adds to a frame.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LOAD_SPECIES_H
#define PM_LOAD_SPECIES_H

#include "distribution/distribution.h"
#include "scene-parts/scene-loading.h"
#include "stream/frame.h"

struct pm_species {
	const char *name;                   /* of the set */
	uint64_t n, seed;
	double charge, mass;                /* of one real particle */
	const char *density;                /* real particles per volume, in x y z; NULL: 1 */
	bool weighted;                      /* particles evenly, weights in proportion to the density; else equal weights */
	const struct pm_distribution *distribution;
	struct pm_distribution_choice choice;
	const char *f[3];                   /* of each component, in v, in place of the distribution; NULL: the distribution */
	const double *range;                /* [length/time] of v in f, 2 numbers; NULL: where f is above 1e-14 of its largest value */
	enum pm_loading loading;            /* not PM_LATTICE */
};

/* Header: the set with x, v, mass, charge and id. 0 or failure. */
int pm_species_declare(const struct pm_species *s, struct pm_frame *f);
/* Data. *weight: real particles for which one stands (their mean). 0 or failure. */
int pm_species_fill(const struct pm_species *s, struct pm_frame *f, double *weight);

#endif
