/* The current of a frame's charges on its mesh; used by p2m --current. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CURRENT_FRAME_H
#define PM_CURRENT_FRAME_H

#include "current/current.h"
#include "transfer/spread-frame.h"

/* The choice applied to a frame. */
struct pm_current_job {
	struct pm_current current;
	const struct pm_law *law;
	struct pm_sets sets;
	struct pm_mesh *mesh; /* NULL: to be made before pm_current_declare */
};

/* Each 0 or failure. In declare(): */
int pm_current_choose(const struct pm_spread_choice *choice, const char *deposit, const struct pm_frame *f, struct pm_current_job *j);
int pm_current_declare(struct pm_current_job *j, struct pm_frame *f); /* makes J: the change of the law's field, staggered as this is */
/* With the data: all sets. */
int pm_current_frame(struct pm_current_job *j, struct pm_frame *f);

#endif
