/* The account of strengths (mass, charge, circulation ...): their sums over the particle sets of a frame, and what its words report to have taken away or
 * added by permission. A strength is an extensive state of particles other than volume, which is a measure of the lattice and not conserved.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_STRENGTHS_H
#define PM_STREAM_STRENGTHS_H

#include "stream/frame.h"

enum { PM_STRENGTHS = 32, PM_STRENGTH_NAME = PM_NAME + 16 };

/* A change of the sum that no permission accounts for is an error above this part of the sum of absolute values. */
static const double pm_strength_tolerance = 1e-3;

struct pm_strength {
	char on[PM_NAME];            /* the set */
	char name[PM_STRENGTH_NAME]; /* of the field; with _0, _1 ... for its components if it has several */
	double sum, scale;           /* of the values, and of their absolute values */
	double size;                 /* the largest scale of the components of the same vector: a component that vanishes has round-off of this */
};
struct pm_strengths {
	int n;
	struct pm_strength of[PM_STRENGTHS];
};

bool pm_is_strength(const struct pm_field *field);
/* NAME, or NAME_c of component c. */
void pm_strength_name(const struct pm_field *field, int c, char name[PM_STRENGTH_NAME]);
/* Appends the components of a field, once. */
void pm_strengths_add(const struct pm_field *field, struct pm_strengths *s);
const struct pm_strength *pm_strength_find(const struct pm_strengths *s, const char *on, const char *name); /* NULL: none */
/* Of one set, or (NULL) of all, where the values are in memory. Compensated, the same for any number of threads; cost N. */
void pm_strengths_of(const struct pm_frame *f, const char *set, struct pm_strengths *s);

/* What the words have reported under KEY_NAME, summed over the words. */
double pm_strength_reported(const struct pm_frame *f, const char *key, const char *name);
/* By how much the words were allowed to change the sum: what was given, less what was absorbed, cut off and left outside. */
double pm_strength_permitted(const struct pm_frame *f, const char *name);

#endif
