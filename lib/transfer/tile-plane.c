/* Cloud in cell in the plane, eight (or four) particles at a time: they find their cells and weights together, then each adds to the two points of two rows
 * of the block, or reads them. Every sum has the order of the loops for all kernels (transfer-tile.c): the same bytes. Cost: four products a particle.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/tile-eight.h"
#include "transfer/tile-plane.h"

enum { row = 64 + 12 };

bool pm_tile_has_plane(int dim, const struct pm_kernel *k) { return PM_TILE_CIC_EIGHT && dim == 2 && k->width == 2 && k->degree == 1; }

/* Their first points in the block. */
PM_SIMD_INLINE pm_simd_int point_of(const struct eight *e) { return e->cell[1] * row + e->cell[0]; }

/* The first n of a vector of particles. */
PM_SIMD_INLINE void add_rows(size_t n, const struct eight *e, pm_simd q, double *block)
{
	const pm_simd x = e->distance[0], y = e->distance[1], low = (1 - y) * q, high = y * q;
	int32_t at[PM_SIMD_WIDTH];
	pm_simd2_at below[PM_SIMD_WIDTH], above[PM_SIMD_WIDTH];
	*(pm_simd_int_at *)at = point_of(e);
	pm_simd_to_pairs((1 - x) * low, x * low, below);
	pm_simd_to_pairs((1 - x) * high, x * high, above);
	PM_SIMD_UNROLL
	for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
		if (l < n) {
			double *to = block + (size_t)(uint32_t)at[l];
			*(pm_simd2_at *)to += below[l];
			*(pm_simd2_at *)(to + row) += above[l];
		}
}

void pm_tile_plane_spread(const struct pm_tile *t, const struct pm_tile_batch *b, const double *q)
{
	size_t i = 0;
	for (; i + PM_SIMD_WIDTH <= b->m; i += PM_SIMD_WIDTH) {
		const struct eight e = find_eight_of(2, t, b, i);
		__builtin_prefetch(b->next_value + i, 0, 2);
		add_rows(PM_SIMD_WIDTH, &e, pm_simd_load_any(q + i), t->block);
	}
	if (i < b->m) {
		double few[PM_SIMD_WIDTH] = {0};
		const struct eight e = find_eight_of(2, t, b, i);
		memcpy(few, q + i, (b->m - i) * sizeof *q);
		add_rows(b->m - i, &e, pm_simd_load_any(few), t->block);
	}
}

void pm_tile_plane_spread_records(const struct pm_tile *t)
{
	for (size_t i = 0; i < t->count; i += PM_SIMD_WIDTH) {
		const size_t n = t->count - i < PM_SIMD_WIDTH ? t->count - i : PM_SIMD_WIDTH;
		pm_simd q, unused;
		const struct eight e = find_eight_in_plane(t, i, &q, &unused);
		if (t->value > 2) {
			double few[PM_SIMD_WIDTH];
			for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
				few[l] = t->records[(i + (l < n ? l : 0)) * (size_t)t->stride + (size_t)t->value];
			q = pm_simd_load_any(few);
		}
		if (n == PM_SIMD_WIDTH)
			add_rows(PM_SIMD_WIDTH, &e, q, t->block);
		else
			add_rows(n, &e, q, t->block);
	}
}

PM_SIMD_INLINE pm_simd value_of(const struct places *p, size_t i, const double *block)
{
	const pm_simd x = pm_simd_load(p->distance[0] + i), y = pm_simd_load(p->distance[1] + i);
	pm_simd a, b, c, d;
	load_pairs(block, p->at + i, &a, &b);
	load_pairs(block + row, p->at + i, &c, &d);
	const pm_simd below = a * (1 - y) + c * y, above = b * (1 - y) + d * y;
	return (0 + below * (1 - x)) + above * x; /* 0 +: as the loop begins, so that no sum is -0 */
}

bool pm_tile_plane_gather(const struct pm_tile *t, const struct pm_tile_batch *b, const struct pm_tile_results *r)
{
	struct delivery to[PM_COMPONENTS];
	struct places places;
	pm_simd nothing = {0};
	for (int c = 0; c < t->components; c++)
		to[c] = delivery_of(r, c);
	for (size_t from = 0, end; from < b->m; from = end) {
		end = find_places(2, t, b, from, point_of, &places);
		for (size_t i = from; i < end; i += PM_SIMD_WIDTH) {
			const size_t n = end - i < PM_SIMD_WIDTH ? end - i : PM_SIMD_WIDTH;
			if (t->components == 1) { /* not in the loop: see tile-cic.c */
				deliver_eight(value_of(&places, i - from, t->block), n, &to[0], b->p + i, &nothing);
				continue;
			}
			for (int c = 0; c < t->components; c++)
				deliver_eight(value_of(&places, i - from, t->block + (size_t)c * PM_BLOCK_MOST), n, &to[c], b->p + i, &nothing);
		}
	}
	return !pm_simd_outside(nothing, (pm_simd){0}, (pm_simd){0});
}

void pm_tile_plane_gather_records(const struct pm_tile *t)
{
	const size_t to = (size_t)t->to;
	for (size_t i = 0; i < t->count; i += PM_SIMD_WIDTH) {
		const size_t n = t->count - i < PM_SIMD_WIDTH ? t->count - i : PM_SIMD_WIDTH;
		pm_simd third, fourth;
		const struct eight e = find_eight_in_plane(t, i, &third, &fourth);
		struct places places;
		put_eight(2, &e, point_of, 0, &places);
		for (int c = 0; c < t->components; c++) {
			const pm_simd v = value_of(&places, 0, t->block + (size_t)c * PM_BLOCK_MOST);
			double *result = t->results + i * to + (size_t)c;
			for (size_t l = 0; l < n; l++)
				result[l * to] = v[l];
		}
	}
}
