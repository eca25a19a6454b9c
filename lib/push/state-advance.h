/* The loops of push: blocks of particles that stay in cache; on each all actions of the push, then the faces of the box (wrap, reflect),
 * so that a push costs one pass through memory. Elementwise: the same bytes for any number of threads.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_STATE_ADVANCE_H
#define PM_PUSH_STATE_ADVANCE_H

#include "step/step.h"

enum { PM_ADVANCE_BLOCK = 1024, PM_ADVANCE_ACTIONS = 16 };

/* One component of one state, with its rate and registers; n values each. */
struct pm_advanced {
	double *y;
	const double *k;
	double *q[PM_REGISTERS]; /* NULL beyond those in use */
	bool position;
	float *y_floats;         /* where y is NULL: it is held as floats */
	const float *k_floats;
};

/* What one push does to one group of lines. */
struct pm_advance {
	int actions;
	struct {
		const struct pm_step *step;
		int pass;
		double dt;
	} action[PM_ADVANCE_ACTIONS];
	int shift;     /* number of registers that hold old rates: the newest goes to q[0]; 0 none */
	int registers; /* those of the scheme itself come after this many */
};

/* The faces an axis has for one set. */
struct pm_bounds {
	double lo, hi; /* [length] */
	bool fold, mirror[2];
	float *x_floats, *v_floats; /* where x and v are NULL: they are held as floats */
};

/* Advances n particles along one axis (or, with x NULL, states without an axis). lines: positions first, because their rate is the velocity
 * before this pass; kicks, however, are done before drifts, which use the new velocity. True if everything is finite afterwards. *fastest (NULL: not
 * wanted) is then the largest |rate| of the positions [length/time]. */
bool pm_advance_axis(size_t n, const struct pm_advance *a, int nlines, const struct pm_advanced *lines, double *x, double *v,
	const struct pm_bounds *b, double *fastest);

/* The same of n <= PM_ADVANCE_BLOCK particles, by the thread that calls, without floats and mirrors; *most (NULL: not wanted) is raised to the bits of the
 * largest |rate| of positions. */
bool pm_advance_few(size_t n, const struct pm_advance *a, int nlines, const struct pm_advanced *lines, double *x, const struct pm_bounds *b, int64_t *most);

#endif
