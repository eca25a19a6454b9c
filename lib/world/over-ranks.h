/* Sums and other parts over a set whose stretches are on many ranks, by the law of sums (base/in-order.h): the same bytes as alone.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_WORLD_OVER_RANKS_H
#define PM_WORLD_OVER_RANKS_H

#include "base/in-order.h"
#include "world/world.h"

/* As pm_over_set, called by all ranks in the same order. Each has the values 0 <= i < here of data; stretches begin at multiples of pm_sum_block in the
 * stream. `all` is joined to on rank 0, and is then the same on all ranks. What travels: p->size bytes per block to rank 0, and p->size to all. Takes the
 * caller's status and returns the agreed one (world.h). */
int pm_world_over_set(int status, const struct pm_parts *p, const void *data, size_t here, void *all);
/* As pm_over_mesh in the same way, over the planes (in 2-D and 1-D the rows) of all ranks: `here` of them with the values of data, which make() counts from the
 * first one here. */
int pm_world_over_mesh(int status, const struct pm_parts *p, const void *data, const size_t points[3], size_t here, void *all);
/* pm_sum_of_set in the same way. */
int pm_world_sum_of_set(int status, size_t here, const double *x, const double *y, struct pm_sum *all);

#endif
