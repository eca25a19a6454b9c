/* The linear modes of the map that a sentence makes of a frame. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MODES_MODES_H
#define PM_MODES_MODES_H

#include "modes/arnoldi.h"
#include "modes/state-vector.h"

struct pm_modes_choice {
	int64_t steps;       /* of the map */
	int64_t vectors;     /* at most */
	double displacement; /* of the differences, in scales of the state */
	double neutral;      /* growth per step below this is none */
	double tolerance;    /* relative residual at which the leading mode is found */
	int64_t seed;        /* of the start vector */
	bool moving;         /* linearise about a state that is no equilibrium */
};

struct pm_modes {
	struct pm_state_vector state;
	struct pm_arnoldi found;
	double moves;    /* the largest change of the state in the map, in scales */
	double dt;       /* [time] of a step */
	int64_t steps;
};

/* One mode, per step. */
struct pm_mode {
	double growth;    /* ln|lambda| */
	double error;     /* of it: the residual over |lambda|, and 1e-7 of the differences */
	double frequency; /* arg(lambda) [radians] */
	bool unstable;
};

int pm_modes_run(struct pm_modes *m, const struct pm_frame *f, const char *sentence, const struct pm_modes_choice *c); /* free in any case */
struct pm_mode pm_modes_mode(const struct pm_modes *m, const struct pm_modes_choice *c, int k);
int pm_modes_fields(const struct pm_modes *m, int k, struct pm_frame *f); /* mode_x, mode_v ... of mode k, the largest mode_x 1 */
void pm_modes_free(struct pm_modes *m);

#endif
