/* The work on one tile: particles to a block of mesh points and back. For lib/transfer and lib/current.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_H
#define PM_TRANSFER_TILE_H

#include "transfer/transfer-axis.h"

/* log2 of the cells per tile and axis, by dim. Fixed: sums are made tile by tile. */
static const int pm_tile_shift[4][3] = {{0, 0, 0}, {12, 0, 0}, {6, 6, 0}, {5, 4, 3}}; /* long rows, because the mesh is read and written in rows */

/* A block holds the points of a tile and of the kernels that reach over its edges, with room for whole vectors: those of neighbours (tile-neighbours.h) end
 * 16 points beyond a cell, of the last row of a line too. Its rows have this many points, its planes this many rows. */
enum { PM_BLOCK_ROW = 32 + 12, PM_BLOCK_ROWS = 16 + 11, PM_BLOCK_PLANES = 8 + 12 }; /* in space; together a number of whole lines */
static const int pm_block_row[4] = {0, 4096 + 16, 64 + 12, PM_BLOCK_ROW};
static const int pm_block_rows[4] = {0, 1, 64 + 11, PM_BLOCK_ROWS};
static const int pm_block_planes[4] = {0, 1, 1, PM_BLOCK_PLANES};
enum { PM_BLOCK_MOST = PM_BLOCK_ROW * PM_BLOCK_ROWS * PM_BLOCK_PLANES, PM_TILE_CELLS = 4096 };
/* A square is the four points beside a point of a row of cells, at y and y + 1, z and z + 1; a row has 33, to whole lines of the cache 34. */
enum { PM_SQUARE = 4, PM_ROW_SQUARES = 34, PM_PLANE_SQUARES = 16 * PM_ROW_SQUARES, PM_TILE_SQUARES = 8 * PM_PLANE_SQUARES * PM_SQUARE };

/* Arguments of the loops over particles. */
struct pm_tile {
	const struct pm_kernel *kernel;
	double shift;           /* of the axes: t = u - cell - shift */
	size_t cell[3];         /* the first of the tile */
	size_t count;           /* particles */
	int stride;             /* doubles per record */
	int value;              /* spread: place of the strength in the record */
	int components;         /* gather */
	double *block;          /* spread: added to; gather: [components][PM_BLOCK_MOST], read */
	double *records;        /* [count][stride] */
	double *results;        /* gather: [count][to], may be the records */
	int to;
	double *nodes;          /* gather: NULL, or the components of each point of the block side by side, four each (tile-vector.h) */
	double *squares;        /* NULL, or (tile-cic.h, tile-line.h) spread: [PM_TILE_SQUARES], zero before, after; gather: so for each component */
};

/* Chosen by dim and the kernel's width and degree. */
typedef void pm_tile_loop(const struct pm_tile *t);
pm_tile_loop *pm_tile_spread(int dim, const struct pm_kernel *k, bool squares);
pm_tile_loop *pm_tile_gather(int dim, const struct pm_kernel *k);

/* m particles of a tile in space, from one on, in the order of their cells, m <= PM_TILE_CELLS: those that come one after the other then read the same
 * points, while they are in the nearest cache. Which comes first changes no value. */
void pm_tile_order_cells(const struct pm_tile *t, size_t from, size_t m, uint16_t *index);

/* In 3-D a kernel of two points has two squares of four: where there are about as many particles as cells (count of a job), those beside every point of a row
 * are stored side by side. A particle is two additions of four numbers, and the squares are added up once; or it reads two squares. On a line the points of
 * every cell are stored side by side. */
bool pm_tile_has_squares(int dim, const struct pm_kernel *k, size_t count);

#endif
