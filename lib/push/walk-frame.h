/* The sets of a frame walk at random: what walk does. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_WALK_FRAME_H
#define PM_PUSH_WALK_FRAME_H

#include "push/push-set.h"

struct pm_walk {
	const char *set;  /* only this set; NULL: every set that moves */
	double deviation; /* [length] of a step, sqrt(2 nu dt); not needed in the header */
	uint64_t seed;
};

/* Header, only between two steps (substep 0): declares the positions changed and drops fields derived from them. 0 or failure. */
int pm_walk_declare(const struct pm_walk *w, struct pm_frame *f);
/* Data: walk and faces of a set; *absorbed is the number of particles removed, lost the sums of their strengths. 0 or failure. */
int pm_walk_set(const struct pm_walk *w, struct pm_frame *f, struct pm_set *set, uint64_t *absorbed, struct pm_strengths *lost);
bool pm_walk_takes(const struct pm_walk *w, const struct pm_frame *f, const struct pm_set *set);

#endif
