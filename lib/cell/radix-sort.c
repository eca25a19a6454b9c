/* A stable order. Keys that are few, as those of cells with particles in each, are counted, and every particle goes to its place at once; others by radix sort,
 * least digit first, 11 bits a pass, without the digits that are equal in all keys. A stable order is unique, so it is the same for any number of threads.
 * Cost: two passes over the keys; of radix sort N per pass, of 8 bytes for up to 2^32 cells and particles, and at most 3 passes for these.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "cell/radix-sort.h"
#include "transfer/transfer-tile.h"

enum { bits = 11, digits = 1 << bits, few_most = 256, chunks_most = 16, counted_most = 1 << 20 };

/* Cells on an axis of a few particles; not by fmin and fmax, which are calls. NaN is in the first. */
static void cells_of(const struct pm_grid *g, int axis, size_t m, const double *x, uint64_t cell[few_most])
{
	const double lo = g->lo[axis], h = g->h[axis], n = (double)g->cells[axis];
	const bool periodic = g->face[axis][0] == PM_PERIODIC;
	double at[few_most];
	int outside = 0;
	for (size_t i = 0; i < m; i++) {
		at[i] = floor((x[i] - lo) / h);
		outside |= !(at[i] >= 0 && at[i] < n);
	}
	for (size_t i = 0; i < m && outside; i++) {
		double s = at[i];
		s = periodic ? s - n * floor(s / n) : s;
		s = s > 0 ? s : 0;
		at[i] = s < n - 1 ? s : n - 1;
	}
	for (size_t i = 0; i < m; i++)
		cell[i] = (uint64_t)(int64_t)at[i];
}

void pm_keys_of_cells(const struct pm_grid *g, size_t n, const double *const x[], uint64_t *key)
{
#pragma omp parallel for schedule(static) if (n > 16384)
	for (size_t p = 0; p < n; p += few_most) {
		const size_t m = n - p < few_most ? n - p : few_most;
		uint64_t cell[few_most], tile[few_most] = {0}, inside[few_most] = {0};
		for (int a = g->dim - 1; a >= 0; a--) {
			const int shift = pm_tile_shift[g->dim][a];
			const uint64_t tiles = (g->cells[a] >> shift) + 1, mask = (1u << shift) - 1;
			cells_of(g, a, m, x[a] + p, cell);
			for (size_t i = 0; i < m; i++) {
				tile[i] = tile[i] * tiles + (cell[i] >> shift);
				inside[i] = inside[i] << shift | (cell[i] & mask);
			}
		}
		for (size_t i = 0; i < m; i++)
			key[p + i] = tile[i] * PM_TILE_CELLS + inside[i];
	}
}

void pm_keys_of_reals(size_t n, const double *y, uint64_t *key)
{
	for (size_t i = 0; i < n; i++) {
		double v = y[i] + 0.0; /* -0 + 0 is 0 */
		memcpy(key + i, &v, sizeof v);
		key[i] ^= key[i] >> 63 ? UINT64_MAX : (uint64_t)1 << 63;
	}
}

void pm_keys_of_integers(size_t n, const int64_t *y, uint64_t *key)
{
	for (size_t i = 0; i < n; i++)
		key[i] = (uint64_t)y[i] ^ (uint64_t)1 << 63;
}

/* A pass over numbers whose upper half is the key: each of the chunks has its places for every digit. */
static void pass(size_t n, int shift, const uint64_t *from, uint64_t *to)
{
	uint32_t start[chunks_most][digits];
	const int threads = pm_threads(), chunks = n < 65536 ? 1 : threads < chunks_most ? threads : chunks_most;
	const size_t each = (n + (size_t)chunks - 1) / (size_t)chunks;
#pragma omp parallel for num_threads(chunks) schedule(static, 1) if (chunks > 1)
	for (int c = 0; c < chunks; c++) {
		const size_t begin = (size_t)c * each, end = begin + each < n ? begin + each : n;
		memset(start[c], 0, sizeof start[c]);
		for (size_t i = begin; i < end; i++)
			start[c][from[i] >> shift & (digits - 1)]++;
	}
	uint32_t at = 0;
	for (int d = 0; d < digits; d++)
		for (int c = 0; c < chunks; c++) {
			const uint32_t count = start[c][d];
			start[c][d] = at;
			at += count;
		}
#pragma omp parallel for num_threads(chunks) schedule(static, 1) if (chunks > 1)
	for (int c = 0; c < chunks; c++) {
		const size_t begin = (size_t)c * each, end = begin + each < n ? begin + each : n;
		for (size_t i = begin; i < end; i++)
			to[start[c][from[i] >> shift & (digits - 1)]++] = from[i];
	}
}

/* Keys that differ in their lower half alone, as those of cells: they travel together with the index. */
static void order_halves(size_t n, uint32_t differs, const uint64_t *key, uint64_t *a, uint64_t *b, size_t *order)
{
	uint64_t *from = a, *to = b;
#pragma omp parallel for schedule(static) if (n > 65536)
	for (size_t i = 0; i < n; i++)
		a[i] = key[i] << 32 | i;
	for (int shift = 0; shift < 32; shift += bits) {
		if (!(differs >> shift & (digits - 1)))
			continue;
		pass(n, 32 + shift, from, to);
		uint64_t *k = from;
		from = to, to = k;
	}
#pragma omp parallel for schedule(static) if (n > 65536)
	for (size_t i = 0; i < n; i++)
		order[i] = from[i] & UINT32_MAX;
}

/* The chunks' places of every key are in `start`, of 2 n numbers. */
static bool order_by_counts(size_t n, size_t keys, const uint64_t *key, uint32_t *start, size_t *order)
{
	const size_t threads = (size_t)pm_threads(), room = 2 * n / keys, most = room && n < 65536 ? 1 : threads < room ? threads : room;
	const size_t each = most ? (n + most - 1) / most : 0;
	if (!most || n > UINT32_MAX)
		return false;
#pragma omp parallel for num_threads(most) schedule(static, 1) if (most > 1)
	for (size_t c = 0; c < most; c++) {
		uint32_t *count = start + c * keys;
		memset(count, 0, keys * sizeof *count);
		for (size_t i = c * each, end = i + each < n ? i + each : n; i < end; i++)
			count[key[i]]++;
	}
	uint32_t at = 0;
	for (size_t k = 0; k < keys; k++)
		for (size_t c = 0; c < most; c++) {
			const uint32_t count = start[c * keys + k];
			start[c * keys + k] = at;
			at += count;
		}
#pragma omp parallel for num_threads(most) schedule(static, 1) if (most > 1)
	for (size_t c = 0; c < most; c++) {
		uint32_t *to = start + c * keys;
		for (size_t i = c * each, end = i + each < n ? i + each : n; i < end; i++)
			order[to[key[i]]++] = i;
	}
	return true;
}

void pm_keys_order(size_t n, uint64_t *key, uint64_t *key_work, size_t *order, size_t *order_work)
{
	uint64_t *from = key, *to = key_work, differs = 0, most = 0;
	size_t *from_order = order, *to_order = order_work;
#pragma omp parallel for schedule(static) reduction(| : differs) reduction(max : most) if (n > 65536)
	for (size_t i = 0; i < n; i++)
		differs |= key[i] ^ key[0], most = key[i] > most ? key[i] : most;
	if (most < counted_most && order_by_counts(n, (size_t)most + 1, key, (uint32_t *)key_work, order))
		return;
	if (!(differs >> 32) && n <= UINT32_MAX) {
		order_halves(n, (uint32_t)differs, key, key_work, (uint64_t *)order_work, order);
		return;
	}
	for (size_t i = 0; i < n; i++)
		order[i] = i;
	for (int shift = 0; shift < 64; shift += bits) {
		size_t start[digits] = {0}, at = 0;
		if (!(differs >> shift & (digits - 1)))
			continue;
		for (size_t i = 0; i < n; i++)
			start[from[i] >> shift & (digits - 1)]++;
		for (int d = 0; d < digits; d++) {
			size_t count = start[d];
			start[d] = at;
			at += count;
		}
		for (size_t i = 0; i < n; i++) {
			size_t place = start[from[i] >> shift & (digits - 1)]++;
			to[place] = from[i], to_order[place] = from_order[i];
		}
		uint64_t *k = from;
		size_t *o = from_order;
		from = to, to = k, from_order = to_order, to_order = o;
	}
	if (from_order != order)
		memcpy(order, from_order, n * sizeof *order);
}
