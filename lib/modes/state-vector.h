/* The state of a frame as one vector of numbers of order 1, for linear algebra. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MODES_STATE_VECTOR_H
#define PM_MODES_STATE_VECTOR_H

#include "stream/frame.h"

enum { PM_STATE_PARTS = 64 };
struct pm_state_part {
	char on[PM_NAME], name[PM_NAME];
	enum pm_role role;
	int components;
	size_t count;
	double scale;  /* positions: the mean distance of particles; velocities and registers: that per step; others: their rms */
	bool position; /* differences are those to the nearest image */
};
struct pm_state_vector {
	size_t n;
	int parts;
	struct pm_state_part part[PM_STATE_PARTS];
	double period[3]; /* of the box, 0 not periodic */
};

/* Positions and values of what moves, registers, and strengths and mesh fields that have a rate. rates: f with these; dt: of the step. */
int pm_state_vector_of(struct pm_state_vector *v, const struct pm_frame *f, const struct pm_frame *rates, double dt);
/* A copy of f moved by `by` times the vector; without rates and derived fields. NULL: failed. */
struct pm_frame *pm_state_moved(const struct pm_state_vector *v, const struct pm_frame *f, const double *vector, double by);
/* out = (a - b)/by; fails where they do not hold the same particles. */
int pm_state_difference(const struct pm_state_vector *v, const struct pm_frame *a, const struct pm_frame *b, double by, double *out);

#endif
