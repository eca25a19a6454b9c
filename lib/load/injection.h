/* A source of particles at a face of the box or in its volume: what the word inject adds in every step. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LOAD_INJECTION_H
#define PM_LOAD_INJECTION_H

#include "stream/frame.h"

struct pm_injection {
	const char *set;
	int axis, side;        /* the face: 0..2; 0 low, 1 high. axis -1: everywhere in the box */
	uint64_t seed;
	double charge, mass;   /* of one real particle */
	double density, flux;  /* [1/volume] of the Maxwellian beyond the face; [1/(area time)], in the box [1/(volume time)]. One of them is NAN */
	double weight, number; /* real particles for which one stands; particles a step. Both NAN: the weight of the particles of the set */
	double vth[3], drift[3]; /* [length/time] standard deviation of each component of v; mean velocity */
	int velocities;        /* components of v of a set that is made here */
	const char *share;     /* of the particles that come in, 0 to 1, an expression in x y z time; NULL: all */
};

enum pm_injection_act { PM_INJECTION_WAITS, PM_INJECTION_ACTS }; /* it acts between steps, or within one where its set has drifted */

/* Header: the set, made if it is missing; its fields will grow. Fills weight. One of pm_injection_act, or failure. */
int pm_injection_declare(struct pm_injection *s, struct pm_frame *f);
/* Data, with the choice that declare was given. Fills weight; *came: the number of particles that came in. 0 or failure. */
int pm_injection_step(struct pm_injection *s, struct pm_frame *f, uint64_t *came);
/* [1/(area time)] through a plane, in the direction of the drift: density 1, standard deviation vth. */
double pm_injection_flux(double drift, double vth);

#endif
