/* The nodes of a tile, of a gradient that is left to be made. Private to lib/transfer. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_GRADIENT_H
#define PM_TRANSFER_TILE_GRADIENT_H

#include "mesh/gradient-later.h"
#include "transfer/tile-pass.h"

/* Nodes of a block in a periodic box: along each axis at[slots] of the mesh, of which along x those from..to-1 follow each other there. */
struct pm_tile_nodes {
	const size_t *at[3];
	size_t slots[3], from, to;
};
/* Their components: to block[dim][PM_BLOCK_MOST], or in space, if not NULL, to nodes as pm_tile_weave leaves them. */
void pm_tile_gradient_of(const struct pm_gradient_later *l, const struct pm_tile_nodes *b, double *block, double *nodes);
/* m nodes of a row, from at[axis] on: to[components][apart]. */
void pm_tile_gradient_row(const struct pm_gradient_later *l, const size_t at[3], size_t m, double *to, size_t apart);
/* In space: of the eight nodes at[axis][2]; x runs fastest. */
void pm_tile_gradient_beside(const struct pm_gradient_later *l, const size_t at[3][2], double node[8][3]);
/* Asks for the potential that it reads, into the second-level cache. */
void pm_tile_gradient_of_fetch(const struct pm_gradient_later *l, const struct pm_tile_nodes *b);

/* The components of a job's nodes, as pm_tile_load_block would read them from the mesh: to block[dim][PM_BLOCK_MOST], or in space, if not NULL, to nodes as
 * pm_tile_weave leaves them. */
void pm_tile_gradient(const struct pm_gradient_later *l, const struct pm_tile_pass *p, const struct pm_tile_job *j, double *block, double *nodes);
/* Asks for the potential that it reads for a job, if there is one, into the second-level cache. */
void pm_tile_gradient_fetch(const struct pm_gradient_later *l, const struct pm_tile_pass *p, const struct pm_tile_job *j);

#endif
