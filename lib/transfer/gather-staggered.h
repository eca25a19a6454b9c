/* The staggered gather a few particles at a time, for a pass that makes their rates itself. For lib/transfer and lib/current.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_GATHER_STAGGERED_H
#define PM_TRANSFER_GATHER_STAGGERED_H

#include "transfer/tile-pass.h"

/* Leaves the order of these particles among the nodes with their positions, unless it is there: 1 if they stay in the stream and none is a stray, else 0, or
 * failure. */
int pm_staggered_order(const struct pm_transfer *t, size_t n, const struct pm_column x[]);
struct pm_staggered_few; /* of `threads` */
/* t, mesh[components] and the order stay. 0 or failure; free in any case. */
int pm_staggered_few_new(struct pm_staggered_few **to, const struct pm_transfer *t, const struct pm_tile_order *o, const double *const mesh[], int threads);
/* Of this thread: m particles of a job, m <= PM_TILE_ORDER_PACK, at u[dim] among the nodes, to values[components][PM_TILE_ORDER_PACK]. */
void pm_staggered_few(struct pm_staggered_few *f, const struct pm_tile_job *j, size_t m, const double *const u[3], double *values);
void pm_staggered_few_free(struct pm_staggered_few *f);

#endif
