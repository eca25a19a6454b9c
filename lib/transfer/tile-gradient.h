/* The nodes of a tile, of a gradient that is left to be made. Private to lib/transfer. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_GRADIENT_H
#define PM_TRANSFER_TILE_GRADIENT_H

#include "mesh/gradient-later.h"
#include "transfer/tile-pass.h"

/* The three components of a job's nodes, as pm_tile_load_block would read them from the mesh: to block[3][PM_BLOCK_MOST], or, if not NULL, to nodes as
 * pm_tile_weave leaves them. The box is periodic. */
void pm_tile_gradient(const struct pm_gradient_later *l, const struct pm_tile_pass *p, const struct pm_tile_job *j, double *block, double *nodes);
/* Asks for the potential that it reads for a job, if there is one, into the second-level cache. */
void pm_tile_gradient_fetch(const struct pm_gradient_later *l, const struct pm_tile_pass *p, const struct pm_tile_job *j);

#endif
