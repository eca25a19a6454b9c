/* Particles in the order of tiles of cells. Inside lib/mesh only.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_ORDER_H
#define PM_TRANSFER_ORDER_H

#include "mesh/transfer_axis.h"

/* log2 of the cells per tile and axis, by dim. Fixed: sums are made tile by tile. */
static const int pm_tile_shift[4][3] = {{0, 0, 0}, {12, 0, 0}, {6, 6, 0}, {4, 4, 4}};

struct pm_order {
	int dim, chunks;
	size_t n, tiles;
	uint32_t across[3];   /* tiles per axis; x runs fastest */
	uint32_t *tile;       /* [n] of each particle; `tiles` for strays */
	size_t *begin;        /* [tiles+2] first record of each tile */
	size_t *cursor;       /* [chunks+1][tiles+1] */
	int stride;           /* doubles per record */
	double *records;      /* [n][stride]: u of each axis, then the values */
};

/* Sorts n particles by tile; within a tile they keep the order of the stream. values[nvalues][n] travel along; the records have room for
 * at least `room` doubles. 0 or failure; free in any case. */
int pm_order_init(struct pm_order *o, const struct pm_axis axes[3], int dim, size_t n, const double *const x[], int nvalues,
	const double *const values[], int room, struct pm_strays *strays);
void pm_order_free(struct pm_order *o);
/* to[c][p] += factor[c][p] * (double c of the record of p) for every particle that is no stray; factor[c] NULL: 1. */
void pm_order_return(struct pm_order *o, int nvalues, const double *const factor[], double *const to[]);

#endif
