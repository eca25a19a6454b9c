/* Steps: how push advances state by its rates. push knows no law: x' = v (or vel), v' = acc, s' = its change field.
 * One file per action or scheme. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STEP_H
#define PM_STEP_H

#include "base/base.h"

/* One state field of one set, with its rate; arrays of n values per component. */
struct pm_rate {
	size_t n;
	int components;      /* of the state */
	int given;           /* components of the rate; the missing ones are zero */
	double *y[16];       /* state */
	const double *k[16]; /* rate now */
	double *q[3][16];    /* registers, zero when a scheme starts; scheme->registers of them */
};

struct pm_step {
	const char *name, *sentence, *source;
	int passes;    /* force evaluations per step */
	int order;     /* of the whole scheme */
	int registers; /* per state field */
	bool keeps;    /* registers live across steps (ab2, ab3) */
	double real_limit, imaginary_limit; /* |lambda| dt on the axes */
	double (*at)(int pass); /* stage time of the state after pass 0..passes-1, in units of dt; 1 after the last */
	/* One pass: y is advanced, registers updated; history is the number of earlier rates the registers hold (keeps). */
	void (*pass)(int pass, double dt, struct pm_rate *r);
};

extern const struct pm_step *const pm_steps[]; /* generated from lib/step/, NULL ends */
extern const char *const pm_step_names[];
const struct pm_step *pm_step_find(const char *name); /* NULL with a message */

#endif
