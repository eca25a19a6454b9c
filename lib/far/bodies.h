/* Shared by all far fields that work on particles directly: the sets that are sources and those that are targets, the particles in one array, and
 * the sums back on the sets. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FAR_BODIES_H
#define PM_FAR_BODIES_H

#include "stream/frame.h"

/* The sum, as the law defines it. */
struct pm_far {
	const char *strength;     /* field of the sources */
	const char *change, *of;  /* what is added to, and the state it is the rate of */
	const char *per;          /* change = strength/per * field; NULL: the field itself */
	const char *potential;    /* name of the derived field */
	bool curl;                /* field = (d psi/dy, -d psi/dx), else sign * gradient */
	double sign;
	const char *set;          /* the only set acted on; NULL all. Every set with the strength is a source */
	const char *turning;      /* of vortices in space, whose strength is a vector: its rate of change, NULL not wanted */
	bool vector;              /* the strength and the potential have 3 components, and the field is a velocity */
	bool with_potential;      /* also for sets that are fixed: they store energy */
};

struct pm_bodies {
	size_t targets, n;                /* targets come first, then those that are sources alone */
	size_t sets, *count, *own;        /* the sets in this order, the particles of each, and of each [first, end) of those that are here */
	double *x[3], *q;                 /* n each; q is 0 for test particles */
	double *gradient[3], *potential;  /* room for n each, of unit coefficient; potential NULL if not wanted */
	double *alpha[3], *rate[3], *psi[3]; /* of vector strengths: n each as q and room for n each; NULL otherwise, psi also if not wanted */
};

int pm_far_plan(struct pm_frame *f, const struct pm_far *far, const char *term, bool replace);
/* In a divided frame every rank gets all. 0 or failure, which the ranks agree on. */
int pm_bodies_gather(const struct pm_frame *f, const struct pm_far *far, struct pm_bodies *b);
/* Adds the sums to the sets, with the limits of what is added (stream/limits.h). */
void pm_bodies_scatter(struct pm_frame *f, const struct pm_far *far, double coefficient, const struct pm_bodies *b);
void pm_bodies_free(struct pm_bodies *b);

#endif
