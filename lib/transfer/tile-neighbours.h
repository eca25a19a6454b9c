/* Particles in cells of a row one after the other, as a remesh leaves them and a smooth flow moves them: each lane of a register has a particle, and point k
 * of lane l is point k - 1 of lane l + 1. A row of points is then whole registers: to it are added the products of all particles, moved k lanes up, the
 * largest k first, so that every sum has the order of the particles; or it is read from the k-th point on. No particle waits for what the one before it
 * has stored, and no weights are turned. Private to lib/transfer. Cost: width products a row and register. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_NEIGHBOURS_H
#define PM_TRANSFER_TILE_NEIGHBOURS_H

#include "transfer/transfer-tile.h"

enum { most = 8 /* points */ };

/* Particles side by side: their first points, and their weights; from a later lane on, too, eight are read. */
struct lot {
	int32_t at[PM_SIMD_WIDTH] __attribute__((aligned(32)));
	double x[(most + 1) * PM_SIMD_WIDTH] __attribute__((aligned(64)));        /* [point][particle] */
	double f[(most * most + 1) * PM_SIMD_WIDTH] __attribute__((aligned(64))); /* [z][y][particle] */
};

/* Are all particles with these first points in neighbouring cells? */
PM_SIMD_INLINE bool are_neighbours(pm_simd_int at) { return !pm_simd_int_others(at - pm_simd_int_lanes(), at[0]); }

/* What of a lot stands in neighbouring cells: n runs that begin at at[], the last of which ends at at[n]. More than FEW_RUNS, in space more than one: not
 * worth it. */
enum { FEW_RUNS = 2 };
struct runs {
	int n;
	size_t at[FEW_RUNS + 1];
};

PM_SIMD_INLINE struct runs runs_of(int dim, const struct lot *lot, size_t m)
{
	struct runs r = {.n = 1};
	if (dim == 3)
		return (struct runs){.n = FEW_RUNS + 1};
	for (size_t l = 1; l < m; l++)
		if (lot->at[l] != lot->at[l - 1] + 1) {
			if (r.n == FEW_RUNS)
				return (struct runs){.n = FEW_RUNS + 1};
			r.at[r.n++] = l;
		}
	r.at[r.n] = m;
	return r;
}

/* Rows of points around a particle, and planes of such rows. Loops over rows go to the most there are, and are left out beyond: they are unrolled. */
PM_SIMD_INLINE int rows_of(int dim, int width) { return dim > 1 ? width : 1; }
PM_SIMD_INLINE int planes_of(int dim, int width) { return dim > 2 ? width : 1; }

/* To a row: x[point] f. */
PM_SIMD_INLINE void add_to_row(int width, const pm_simd *x, pm_simd f, double *row)
{
	const int size = (int)PM_SIMD_WIDTH, many = (2 * size + width - 2) / size; /* registers that it takes */
	pm_simd sum[most];
	PM_SIMD_UNROLL
	for (int i = 0; i < many; i++)
		sum[i] = pm_simd_load_any(row + i * size);
	PM_SIMD_UNROLL
	for (int k = width - 1; k >= 0; k--) {
		const int i = k / size, up = k % size;
		const pm_simd product = x[k] * f;
		if (up)
			pm_simd_add_moved(up, product, &sum[i], &sum[i + 1]);
		else
			sum[i] += product;
	}
	PM_SIMD_UNROLL
	for (int i = 0; i < many; i++)
		pm_simd_store_any(row + i * size, sum[i]);
}

/* Neighbours of weights x[point] and f[z][y] to their points, from the first one's on. What is added beyond them is 0, and no sum is -0, as blocks begin with
 * 0. In the plane the rows are unrolled, and their factors stay in registers. */
PM_SIMD_INLINE void spread_neighbours(int dim, int width, const pm_simd *x, const pm_simd_at *f, double *first)
{
	const int across = pm_block_row[dim], plane = across * pm_block_rows[dim];
	PM_SIMD_UNROLL
	for (int y = 0; y < most; y++)
		if (dim < 3 && y < rows_of(dim, width))
			add_to_row(width, x, f[y], first + y * across);
	for (int row = 0; row < width * width && dim == 3; row++)
		add_to_row(width, x, f[row], first + row / width * plane + row % width * across);
}

/* sum[point] of a row, times its factor. */
PM_SIMD_INLINE void add_row_of(int width, const double *row, pm_simd f, pm_simd *sum)
{
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++)
		sum[k] += pm_simd_load_any(row + k) * f;
}

/* Values at neighbours. */
PM_SIMD_INLINE pm_simd gather_neighbours(int dim, int width, const pm_simd *x, const pm_simd_at *f, const double *first)
{
	const int across = pm_block_row[dim], plane = across * pm_block_rows[dim];
	pm_simd sum[most], value = {0};
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++)
		sum[k] = pm_simd_all(0);
	PM_SIMD_UNROLL
	for (int y = 0; y < most; y++)
		if (dim < 3 && y < rows_of(dim, width))
			add_row_of(width, first + y * across, f[y], sum);
	for (int row = 0; row < width * width && dim == 3; row++)
		add_row_of(width, first + row / width * plane + row % width * across, f[row], sum);
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++)
		value += sum[k] * x[k];
	return value;
}

#endif
