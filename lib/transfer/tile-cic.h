/* Loops for the kernel of two linear points in 3-D, over particles straight from the stream and over records. Private to lib/transfer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_CIC_H
#define PM_TRANSFER_TILE_CIC_H

#include "transfer/tile-results.h"

/* Whether eight or four particles at a time are worth it: where a register holds less, the loops over records are faster. */
enum { PM_TILE_CIC_EIGHT = (int)PM_SIMD_PART == (int)PM_SIMD_WIDTH };
/* Whether a gather reads squares; where a register holds four, the two points of each row are read from the block. */
enum { PM_TILE_CIC_SQUARES = (int)PM_SIMD_PART == 8 };

/* m particles of the stream from p on, all on the mesh, m <= PM_TILE_ORDER_PACK; axes are those of the order. */
struct pm_tile_batch {
	const struct pm_tile_order *order;
	struct pm_axis_lanes lanes[3];
	size_t p, m;
	const double *x[3];    /* their positions */
	bool *outside;         /* spread: NULL, or set where a particle is not in the tile; then not all of the batch is added */
	const double *next[3], *next_value; /* those of a later batch, and the strengths of a spread, which the loops fetch */
};
static inline struct pm_tile_batch pm_tile_batch(const struct pm_tile_order *o)
{
	struct pm_tile_batch b = {.order = o};
	for (int d = 0; d < o->dim && o->axes; d++)
		b.lanes[d] = pm_axis_lanes(&o->axes[d]);
	return b;
}
/* Loops over a batch: to a tile with strengths q[m]; from it, true if what is left is finite. */
typedef void pm_tile_spread_loop(const struct pm_tile *t, const struct pm_tile_batch *b, const double *q);
typedef bool pm_tile_gather_loop(const struct pm_tile *t, const struct pm_tile_batch *b, const struct pm_tile_results *r);
/* With strengths q[m] to the squares of t. The sums are those of the loops over records. */
void pm_tile_cic_spread(const struct pm_tile *t, const struct pm_tile_batch *b, const double *q);
void pm_tile_cic_spread_records(const struct pm_tile *t);
void pm_tile_cic_spread_eight(const struct pm_tile *t); /* the same, eight records at a time */
/* Row y of plane z of a tile's squares. */
static inline double *pm_row_squares(double *squares, size_t y, size_t z)
{
	return squares + ((z << pm_tile_shift[3][1]) + y) * ((size_t)PM_ROW_SQUARES * PM_SQUARE);
}
/* The squares of the cells[3] cells of the tile to its block, whose values are set, not added to; leaves squares zero. */
void pm_tile_cic_fold(const struct pm_tile *t, const size_t cells[3]);
/* The block of a component to squares[PM_TILE_SQUARES]. */
void pm_tile_cic_unfold(const double *block, const size_t cells[3], double *squares);
/* Values of t's components from their squares [components][PM_TILE_SQUARES]. True if what is left is finite. */
bool pm_tile_cic_gather(const struct pm_tile *t, const struct pm_tile_batch *b, const struct pm_tile_results *r);
void pm_tile_cic_gather_eight(const struct pm_tile *t); /* from records to results, which may be the records */

#endif
