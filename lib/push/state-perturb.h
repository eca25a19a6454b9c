/* Every number of the state moved at random, by units in the last place or by a fraction of itself: the input of a run as uncertain as its storage.
 * A number goes up or down by (seed, set, field, id or index, component) alone, not by threads; 0 stays.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_STATE_PERTURB_H
#define PM_PUSH_STATE_PERTURB_H

#include "stream/frame.h"

struct pm_perturb {
	const char *const *on, *const *fields; /* names of sets and meshes, and of fields; NULL ends; NULL or empty: all */
	uint64_t seed;
	double relative; /* 0: one unit in the last place of the field's type */
};

/* Header, only between two steps: declares the fields changed, drops what was computed from them. The number of fields, or failure. */
int pm_perturb_declare(const struct pm_perturb *p, struct pm_frame *f);
/* Data. Positions are folded back into a periodic box. */
void pm_perturb_apply(const struct pm_perturb *p, struct pm_frame *f);

#endif
