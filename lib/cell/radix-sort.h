/* A stable order of particles by cell or by any key. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CELL_RADIX_SORT_H
#define PM_CELL_RADIX_SORT_H

#include "mesh/grid.h"

/* Number of the cell each position lies in, tile by tile as p2m works (transfer-tile.h), x fastest; a periodic axis wraps, beyond any other face the last
 * cell counts. x[0..dim-1] of n values. */
void pm_keys_of_cells(const struct pm_grid *g, size_t n, const double *const x[], uint64_t *key);
void pm_keys_of_reals(size_t n, const double *y, uint64_t *key); /* ascending; -0 is 0 */
void pm_keys_of_integers(size_t n, const int64_t *y, uint64_t *key);
/* order[i] is the index of the i-th particle; equal keys keep their order. work: n values of each; key is overwritten. */
void pm_keys_order(size_t n, uint64_t *key, uint64_t *key_work, size_t *order, size_t *order_work);

#endif
