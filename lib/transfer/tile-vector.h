/* Gather of the three or four components of a vector at once, in 3-D. Private to lib/transfer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_VECTOR_H
#define PM_TRANSFER_TILE_VECTOR_H

#include "transfer/tile-cic.h"

enum { PM_VECTOR_NODES = 4 * PM_BLOCK_MOST };

enum { PM_NODE_ROW = 4 * PM_BLOCK_ROW, PM_NODE_PLANE = PM_NODE_ROW * PM_BLOCK_ROWS }; /* doubles per row and plane of a block of nodes */
/* Components of a node that lie side by side; of more than four there are several blocks of nodes. */
static inline int pm_vector_group(int components) { return components > 4 ? 3 : components; }
static inline size_t pm_vector_groups(int components) { return components > 4 ? ((size_t)components + 2) / 3 : 1; }

/* Whether `count` particles of a tile are worth it, with this kernel on this processor. */
bool pm_tile_has_vectors(int dim, const struct pm_kernel *k, int components, size_t count);
/* blocks[components][PM_BLOCK_MOST] of which slots[3] are used, to nodes[PM_VECTOR_NODES]: the components of a node side by side. */
void pm_tile_weave(const double *blocks, int components, const size_t slots[3], double *nodes);
/* The loop over records of tiles with nodes. */
pm_tile_loop *pm_tile_gather_vector(const struct pm_kernel *k);
/* That of cic, and the same over particles straight from the stream; true if what is left is finite. */
void pm_tile_cic_gather_vectors(const struct pm_tile *t);
bool pm_tile_cic_gather_vectors_in_order(const struct pm_tile *t, const struct pm_tile_batch *b, const struct pm_tile_results *r);

/* Cells of a periodic mesh that a block has, along each axis: the first of them, how many, and how many the mesh has. */
struct pm_tile_reach {
	int32_t first[3], many[3], cells[3];
};
/* The same of a batch of at most PM_TILE_ORDER_PACK particles anywhere, as bits of beyond[] those that are not in these cells, whose values mean nothing. */
void pm_tile_cic_gather_vectors_near(const struct pm_tile *t, const struct pm_tile_batch *b, const struct pm_tile_reach *reach, const struct pm_tile_results *r,
	uint64_t beyond[PM_TILE_ORDER_PACK / 64]);

#endif
