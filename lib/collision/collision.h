/* How a pair of charges is scattered by the many small-angle encounters of a step: one file per method, chosen by name (docs/methods/collide.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_COLLISION_H
#define PM_COLLISION_H

#include "base/base.h"

struct pm_collision {
	const char *name, *sentence, *source;
	/* 1 - cos of the angle by which the relative velocity turns, in 0..2. s: half of the mean square of the angle where it is small,
	 * 4 pi n log(L) b0^2 u dt with b0 = q_a q_b/(4 pi eps0 m_ab u^2) (Nanbu's s). Random numbers: pm_random and pm_random_normal of key, id, counter. */
	double (*turned)(double s, uint64_t key, uint64_t id, uint64_t counter);
};

extern const struct pm_collision *const pm_collisions[]; /* generated from lib/collision/, NULL ends */
extern const char *const pm_collision_names[];
const struct pm_collision *pm_collision_find(const char *name); /* NULL with a message */

#endif
