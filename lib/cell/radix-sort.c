/* A stable order by radix sort, least digit first, 11 bits a pass; digits that are equal in all keys are skipped. A stable order is unique, so it is
 * the same for any number of threads. Cost: N per pass, 3 passes for 2^33 cells. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "cell/radix-sort.h"
#include "transfer/transfer-tile.h"

enum { bits = 11, digits = 1 << bits };

static uint64_t cell_of(const struct pm_grid *g, int axis, double x)
{
	double s = floor((x - g->lo[axis]) / g->h[axis]), n = (double)g->cells[axis];
	if (g->face[axis][0] == PM_PERIODIC)
		s -= n * floor(s / n);
	return (uint64_t)fmin(fmax(s, 0), n - 1);
}

void pm_keys_of_cells(const struct pm_grid *g, size_t n, const double *const x[], uint64_t *key)
{
#pragma omp parallel for
	for (size_t i = 0; i < n; i++) {
		key[i] = 0;
		uint64_t cell[3] = {0}, inside = 0;
		for (int a = g->dim - 1; a >= 0; a--) {
			int shift = pm_tile_shift[g->dim][a];
			cell[a] = cell_of(g, a, x[a][i]);
			key[i] = key[i] * ((g->cells[a] >> shift) + 1) + (cell[a] >> shift);
			inside = inside << shift | (cell[a] & ((1u << shift) - 1));
		}
		key[i] = key[i] * PM_TILE_CELLS + inside;
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

void pm_keys_order(size_t n, uint64_t *key, uint64_t *key_work, size_t *order, size_t *order_work)
{
	uint64_t *from = key, *to = key_work, differs = 0;
	size_t *from_order = order, *to_order = order_work;
	for (size_t i = 0; i < n; i++)
		order[i] = i, differs |= key[i] ^ key[0];
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

int pm_field_permute(struct pm_field *field, const size_t *order)
{
	size_t n = field->count;
	bool bytes = field->type == PM_U8;
	uint64_t *old = n ? pm_alloc(n, sizeof *old) : NULL;
	if (n && !old)
		return -PM_DATA;
	for (int c = 0; c < field->components; c++) {
		unsigned char *b = bytes ? pm_out_u8(field, c) : NULL, *was = (unsigned char *)old;
		uint64_t *y = bytes ? NULL : (void *)pm_out(field, c); /* eight bytes of either kind */
		memcpy(old, bytes ? (void *)b : (void *)y, n * (bytes ? 1 : sizeof *old));
#pragma omp parallel for
		for (size_t i = 0; i < n; i++)
			if (bytes)
				b[i] = was[order[i]];
			else
				y[i] = old[order[i]];
	}
	pm_free(old);
	return 0;
}
