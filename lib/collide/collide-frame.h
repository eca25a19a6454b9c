/* Collisions of the charges of a frame, cell by cell: what the word collide does (docs/methods/collide.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_COLLIDE_FRAME_H
#define PM_COLLIDE_FRAME_H

#include "collision/collision.h"
#include "stream/frame.h"

enum { PM_COLLIDE_SETS = 16 };

struct pm_collide {
	const char *mesh, *between[2]; /* NULL: the first mesh; all sets with charge, mass and velocity that move, each with itself and each other */
	const struct pm_collision *method;
	double logarithm; /* Coulomb's; NAN: that of each pair of sets, log(Debye length/b0), at least 2 */
	double weight;    /* particles of nature that one of ours stands for; NAN: the constant bodies over the particles, else 1 */
	uint64_t seed;
};

struct pm_collided {
	uint64_t pairs;
	double turn;       /* mean of 1 - cos of their angle, to be expected */
	double logarithm;  /* the least used */
	double fastest;    /* [length/time] before the collisions */
	bool single;       /* nothing said how many charges a particle stands for: one was taken */
	const char *weighted; /* a set whose particles have one charge over mass and unequal masses; NULL none */
};

/* Header: declares what is read and changed. 0 or failure. */
int pm_collide_declare(const struct pm_collide *c, struct pm_frame *f);
/* Data: every particle collides with one or more of its cell, for the step of the frame; sums of momentum and energy stay, to round-off. 0 or failure. */
int pm_collide_step(const struct pm_collide *c, struct pm_frame *f, struct pm_collided *r);

#endif
