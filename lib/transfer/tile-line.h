/* Loops for the kernel of two linear points on a line. Private to lib/transfer. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_LINE_H
#define PM_TRANSFER_TILE_LINE_H

#include "transfer/tile-cic.h"

/* Spread of a batch of a stream that is in order, of strengths q[m], or of records, to the pairs of t.squares: [PM_TILE_CELLS][PM_LINE_PAIRS][2], zero
 * before. Batches of a job begin at even numbers. */
enum { PM_LINE_PAIRS = 2 };
void pm_tile_line_spread(const struct pm_tile *t, const struct pm_tile_batch *b, const double *q);
void pm_tile_line_spread_records(const struct pm_tile *t);
/* The pairs of so many cells to the block, whose values are set, not added to; leaves pairs zero. */
void pm_tile_line_fold(const struct pm_tile *t, size_t cells);
/* Values of t's components from their blocks. True if what is left is finite. */
bool pm_tile_line_gather(const struct pm_tile *t, const struct pm_tile_batch *b, const struct pm_tile_results *r);

#endif
