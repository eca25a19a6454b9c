/* Cloud in cell on a line, four or eight particles at a time straight from the stream. Spread: the two points of a cell lie side by side, so that a particle
 * is one addition of two numbers to its cell; particles take turns between two such pairs, because in a stream that is in the order of cells a sum waits for
 * the one before it. The pairs are added up once a job. Gather: the sums are those of the loops for all kernels, to the last bit.
 * Cost: a pass over the particles, and one over the cells of the tile. SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/tile-eight.h"
#include "transfer/tile-line.h"

enum { cell_size = 2 * PM_LINE_PAIRS };

void pm_tile_line_spread_records(const struct pm_tile *t)
{
	for (size_t i = 0; i < t->count; i++) {
		const double *record = t->records + i * (size_t)t->stride;
		const int32_t cell = (int32_t)record[0]; /* not negative */
		const double x = record[0] - (double)cell, q = record[t->value];
		pm_simd2_at *to = (pm_simd2_at *)(t->squares + ((size_t)cell - t->cell[0]) * cell_size);
		to[i % PM_LINE_PAIRS] += (pm_simd2_at){(1 - x) * q, x * q};
	}
}

/* What the loops over a batch keep in registers. simple: a periodic axis and points on the nodes, where nothing is added to a position. */
struct line {
	struct pm_axis_lanes lanes;
	const struct pm_axis *axis;
	int32_t first;
	const double *x;
	size_t m;
};

static struct line line_of(const struct pm_tile *t, const struct pm_tile_batch *b)
{
	return (struct line){b->lanes[0], &b->order->axes[0], (int32_t)t->cell[0], b->x[0], b->m};
}

static bool is_simple(const struct line *l) { return l->axis->periodic && l->axis->add + l->axis->half == 0; }

/* Cells, and distances from their lower ends, of whole vectors. */
PM_SIMD_INLINE pm_simd find(bool simple, const struct line *l, const double *x, pm_simd_int *cell)
{
	unsigned outside;
	pm_simd u;
	if (simple) {
		u = pm_simd_divide(pm_simd_load_any(x) - l->lanes.lo, l->lanes.h, l->lanes.inverse);
		outside = pm_simd_outside(u, l->lanes.low, l->lanes.high);
	} else
		u = pm_axis_locate_eight(&l->lanes, pm_simd_load_any(x), &outside);
	if (outside) {
		double far[PM_SIMD_WIDTH];
		pm_simd_store_any(far, u);
		pm_axis_locate_far(l->axis, outside, PM_SIMD_WIDTH, x, far);
		u = pm_simd_load_any(far);
	}
	const pm_simd distance = pm_simd_split(u, cell);
	*cell -= l->first;
	return distance;
}

/* The last n < PM_SIMD_WIDTH numbers from i on, with the first of them in the place of the rest. */
static const double *last_few(const double *from, size_t n, double few[PM_SIMD_WIDTH])
{
	for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
		few[l] = from[l < n ? l : 0];
	return few;
}

/* Those of n <= PM_TILE_ORDER_PACK particles from `from` on, in a loop of their own, as in find_places (tile-eight.h): 0.8 of the step of a plasma. What
 * comes next is fetched into the first-level cache where it is near: beside the points of a gather, not beside the pairs of a spread, which fill it (0.95). */
PM_SIMD_INLINE void find_all(bool simple, bool near, const struct line *l, size_t from, size_t n, struct places *to)
{
	const struct line mine = *l; /* in registers */
	const double *x = mine.x + from;
	double few[PM_SIMD_WIDTH];
	pm_simd_int cell;
	for (size_t i = 0; i < n; i += PM_SIMD_WIDTH) {
		if (near)
			__builtin_prefetch(x + i + PM_TILE_AHEAD);
		else
			pm_tile_fetch_ahead(x + i);
		pm_simd_store(to->distance[0] + i, find(simple, &mine, i + PM_SIMD_WIDTH <= n ? x + i : last_few(x + i, n - i, few), &cell));
		*(pm_simd_int_at *)(to->at + i) = cell;
	}
}

/* Whether the particles of a vector are all in one cell. */
PM_SIMD_INLINE bool are_together(const int32_t *at) { return !pm_simd_int_others(*(const pm_simd_int_at *)at, at[0]); }

/* The first n of a vector of particles. */
PM_SIMD_INLINE void add_pairs(size_t n, const int32_t *at, pm_simd x, pm_simd q, double *corners)
{
	pm_simd2_at pair[PM_SIMD_WIDTH];
	pm_simd_to_pairs((1 - x) * q, x * q, pair);
	PM_SIMD_UNROLL
	for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
		if (l < n)
			*(pm_simd2_at *)(corners + (size_t)(uint32_t)at[l] * cell_size + l % PM_LINE_PAIRS * 2) += pair[l];
}

/* The pairs of a cell in registers, while whole vectors of particles are in it: those of a stream in the order of cells. */
struct held {
	int32_t cell; /* -1: none */
	pm_simd2_at pair[PM_LINE_PAIRS];
};

PM_SIMD_INLINE void put_back(struct held *h, double *corners)
{
	if (h->cell < 0)
		return;
	pm_simd2_at *to = (pm_simd2_at *)(corners + (size_t)(uint32_t)h->cell * cell_size);
	to[0] = h->pair[0], to[1] = h->pair[1];
	h->cell = -1;
}

PM_SIMD_INLINE void hold(struct held *h, int32_t cell, double *corners)
{
	if (h->cell == cell)
		return;
	put_back(h, corners);
	const pm_simd2_at *from = (const pm_simd2_at *)(corners + (size_t)(uint32_t)cell * cell_size);
	h->cell = cell, h->pair[0] = from[0], h->pair[1] = from[1];
}

PM_SIMD_INLINE void add_to_held(struct held *h, pm_simd x, pm_simd q)
{
	pm_simd2_at pair[PM_SIMD_WIDTH];
	pm_simd_to_pairs((1 - x) * q, x * q, pair);
	PM_SIMD_UNROLL
	for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
		h->pair[l % PM_LINE_PAIRS] += pair[l];
}

PM_SIMD_INLINE void spread(bool simple, struct line l, const double *q, double *corners)
{
	struct places p;
	size_t i = 0;
	struct held h = {.cell = -1};
	find_all(simple, false, &l, 0, l.m, &p);
	for (; i + PM_SIMD_WIDTH <= l.m; i += PM_SIMD_WIDTH) {
		const pm_simd x = pm_simd_load(p.distance[0] + i);
		pm_tile_fetch_ahead(q + i);
		if (are_together(p.at + i)) {
			hold(&h, p.at[i], corners);
			add_to_held(&h, x, pm_simd_load_any(q + i));
			continue;
		}
		put_back(&h, corners);
		add_pairs(PM_SIMD_WIDTH, p.at + i, x, pm_simd_load_any(q + i), corners);
	}
	put_back(&h, corners);
	if (i < l.m) {
		double few[PM_SIMD_WIDTH];
		add_pairs(l.m - i, p.at + i, pm_simd_load(p.distance[0] + i), pm_simd_load_any(last_few(q + i, l.m - i, few)), corners);
	}
}

void pm_tile_line_spread(const struct pm_tile *t, const struct pm_tile_batch *b, const double *q)
{
	const struct line l = line_of(t, b);
	if (is_simple(&l))
		spread(true, l, q, t->squares);
	else
		spread(false, l, q, t->squares);
}

void pm_tile_line_fold(const struct pm_tile *t, size_t cells)
{
	const pm_simd2_at zero = {0};
	double before = 0;
	for (size_t i = 0; i < cells; i++) {
		pm_simd2_at *cell = (pm_simd2_at *)(t->squares + i * cell_size);
		const pm_simd2_at both = cell[0] + cell[1];
		t->block[i] = before + both[0];
		before = both[1];
		cell[0] = cell[1] = zero;
	}
	t->block[cells] = before;
}

/* The first n of a vector of particles, to the places from p on. */
PM_SIMD_INLINE void gather_some(size_t n, const int32_t *at, pm_simd x, const struct pm_tile *t, int components, const struct delivery to[], size_t p,
	pm_simd *nothing)
{
	const bool one = are_together(at);
	for (int c = 0; c < components; c++) {
		const double *block = t->block + (size_t)c * PM_BLOCK_MOST;
		pm_simd low, high;
		if (one)
			low = pm_simd_all(block[at[0]]), high = pm_simd_all(block[at[0] + 1]);
		else
			load_pairs(block, at, &low, &high);
		deliver_eight(0 + low * (1 - x) + high * x, n, &to[c], p, nothing);
	}
}

PM_SIMD_INLINE bool gather(bool simple, int components, struct line l, const struct pm_tile *t, const struct pm_tile_results *r, size_t p)
{
	const struct pm_tile mine = *t; /* in registers: what is stored might be the caller's */
	struct places places;
	struct delivery to[PM_COMPONENTS];
	pm_simd nothing = {0};
	for (int c = 0; c < components; c++)
		to[c] = delivery_of(r, c);
	for (size_t from = 0; from < l.m; from += PM_TILE_ORDER_PACK, p += PM_TILE_ORDER_PACK) {
		const size_t n = l.m - from < PM_TILE_ORDER_PACK ? l.m - from : PM_TILE_ORDER_PACK;
		size_t i = 0;
		find_all(simple, true, &l, from, n, &places);
		for (; i + PM_SIMD_WIDTH <= n; i += PM_SIMD_WIDTH)
			gather_some(PM_SIMD_WIDTH, places.at + i, pm_simd_load(places.distance[0] + i), &mine, components, to, p + i, &nothing);
		if (i < n)
			gather_some(n - i, places.at + i, pm_simd_load(places.distance[0] + i), &mine, components, to, p + i, &nothing);
	}
	return !pm_simd_outside(nothing, (pm_simd){0}, (pm_simd){0});
}

bool pm_tile_line_gather(const struct pm_tile *t, const struct pm_tile_batch *b, const struct pm_tile_results *r)
{
	const struct line l = line_of(t, b);
	if (t->components == 1)
		return is_simple(&l) ? gather(true, 1, l, t, r, b->p) : gather(false, 1, l, t, r, b->p);
	return is_simple(&l) ? gather(true, t->components, l, t, r, b->p) : gather(false, t->components, l, t, r, b->p);
}
