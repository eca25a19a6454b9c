/* The particles of a frame's sets in another order in memory, by cell or by an expression: what ssort does. Stable.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EXPRESSION_PARTICLE_ORDER_H
#define PM_EXPRESSION_PARTICLE_ORDER_H

#include "stream/frame.h"

struct pm_particle_order {
	const char *set;  /* this set alone; NULL: every set */
	const char *by;   /* expression, ascending; NULL: the cells of the mesh */
	const char *mesh; /* NULL: the first */
	bool reverse;     /* largest first */
};

/* Each 0 or failure. Is there what the order names? */
int pm_particle_order_check(const struct pm_particle_order *o, const struct pm_frame *f);
/* Header: all fields of the sets change. */
int pm_particle_order_declare(const struct pm_particle_order *o, struct pm_frame *f);
/* Data: every field that changes is permuted. */
int pm_particle_order_apply(const struct pm_particle_order *o, struct pm_frame *f);

#endif
