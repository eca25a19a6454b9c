/* Gather of particles where they stand, 64 of the stream at a time (a lot), from the nodes of the tile that most of them are in and of a cell around it: so
 * nearly all are there, and nothing is copied to an order and back. The few beyond have their eight nodes made for themselves. A node's gradient and a
 * particle's weights do not depend on the block: the same bytes as by tiles.
 * Cost: a pass over the runs, a gradient on 1.45 times the nodes, 0.3 us for a particle beyond. SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>

#include "transfer/gather-in-place.h"
#include "transfer/tile-gradient.h"
#include "transfer/tile-vector.h"

enum { LOT = PM_TILE_RUN, PACK = PM_TILE_ORDER_PACK, WORDS = PACK / 64 };
/* Of so many lots so many particles are looked at, and so many of a thousand may be beyond the cells around a tile. */
enum { lots_seen = 32, seen = 16, few = 15 };

/* A tile's cells and those around it, and their nodes. Along an axis that has one tile: all cells. */
struct around {
	struct pm_tile_reach reach;
	struct pm_tile_nodes nodes;
	size_t at[3][PM_BLOCK_ROW];
};

static void around_tile(const struct pm_tile_order *o, size_t tile, struct around *a)
{
	const size_t across[3] = {o->across[0], o->across[1], o->across[2]};
	size_t k[3] = {tile % across[0], tile / across[0] % across[1], tile / across[0] / across[1]};
	for (int d = 0; d < 3; d++) {
		const size_t edge = (size_t)1 << pm_tile_shift[3][d], n = o->axes[d].count, left = n - k[d] * edge, own = left < edge ? left : edge;
		const bool one = across[d] == 1;
		const size_t first = one ? 0 : (k[d] * edge + n - 1) % n, many = one || own + 2 > n ? n : own + 2;
		a->reach.first[d] = (int32_t)first, a->reach.many[d] = (int32_t)many, a->reach.cells[d] = (int32_t)n;
		for (size_t s = 0; s <= many; s++)
			a->at[d][s] = (first + s) % n;
		a->nodes.at[d] = a->at[d], a->nodes.slots[d] = many + 1;
	}
	const size_t n = o->axes[0].count, first = a->at[0][0], slots = a->nodes.slots[0];
	a->nodes.from = first == n - 1, a->nodes.to = a->nodes.from || first + slots < n ? slots : n - first;
}

/* Lots by the tile that most of their particles are in, the home. */
struct lots {
	size_t n;
	uint32_t *home, *lot; /* [n], and in the order of homes */
	size_t *begin;        /* [tiles+1] of lot */
};

static void lots_free(struct lots *l) { pm_free(l->home), pm_free(l->lot), pm_free(l->begin); }

/* The runs of a chunk may begin in the middle of a lot: then the home is that of most in the 64 from there. */
static int find_homes(const struct pm_tile_order *o, struct lots *l)
{
	*l = (struct lots){.n = (o->n + LOT - 1) / LOT};
	unsigned char *most = pm_zalloc(l->n, 1);
	l->home = pm_zalloc(l->n, sizeof *l->home), l->lot = pm_alloc(l->n, sizeof *l->lot), l->begin = pm_zalloc(o->tiles + 2, sizeof *l->begin);
	if (!most || !l->home || !l->lot || !l->begin)
		return pm_free(most), -PM_DATA;
	size_t tile = 0;
	for (size_t k = 0; k < o->runs.n; k++) {
		const struct pm_tile_run *run = &o->runs.run[k];
		const size_t lot = run->at / LOT, many = pm_simd_bits_of_word(run->members);
		while (run->from >= o->begin[tile + 1])
			tile++;
		if (many > most[lot])
			most[lot] = (unsigned char)many, l->home[lot] = (uint32_t)tile;
	}
	pm_free(most);
	for (size_t i = 0; i < l->n; i++)
		l->begin[l->home[i] + 2]++;
	for (size_t t = 0; t < o->tiles; t++)
		l->begin[t + 1] += l->begin[t];
	for (size_t i = 0; i < l->n; i++)
		l->lot[l->begin[l->home[i] + 1]++] = (uint32_t)i;
	return 0;
}

static bool is_beyond(const struct pm_tile_order *o, const struct pm_tile_reach *reach, size_t p)
{
	bool beyond = false;
	for (int d = 0; d < 3; d++) {
		double u = 0;
		pm_axis_locate(&o->axes[d], o->x[d].doubles[p], &u);
		const int32_t c = (int32_t)u - reach->first[d];
		beyond |= (c < 0 ? c + reach->cells[d] : c) >= reach->many[d];
	}
	return beyond;
}

/* Few are beyond the cells around their home, by some of them. */
static bool pays(const struct pm_tile_order *o, const struct lots *l)
{
	size_t all = 0, beyond = 0;
	struct around a;
	for (size_t k = 0; k < lots_seen; k++) {
		const size_t lot = (size_t)((uint64_t)(uint32_t)(k * 2654435769u) * l->n >> 32); /* golden section: not at one place of every tile */
		around_tile(o, l->home[lot], &a);
		for (size_t i = 0; i < seen && lot * LOT + i * (LOT / seen) < o->n; i++, all++)
			beyond += is_beyond(o, &a.reach, lot * LOT + i * (LOT / seen));
	}
	return beyond * 1000 <= few * all;
}

/* ---- the pass ---- */

struct gather {
	const struct pm_gradient_later *gradient;
	const struct pm_tile_order *order; /* as if the stream were in order */
	const struct pm_tile_taker *taker;
	double factor;
	struct pm_tile tile;
	struct pm_tile_batch batch;
	double value[3][PACK];
};

/* The value of particle p alone: the products and sums of tile-vector.c, one after the other. */
static void by_itself(struct gather *g, size_t p, size_t i)
{
	const struct pm_tile_order *o = g->order;
	double t[3], node[8][3];
	size_t at[3][2];
	for (int d = 0; d < 3; d++) {
		double u = 0;
		pm_axis_locate(&o->axes[d], o->x[d].doubles[p], &u);
		at[d][0] = (size_t)u, t[d] = u - (double)at[d][0];
		at[d][1] = at[d][0] + 1 < o->axes[d].count ? at[d][0] + 1 : 0;
	}
	pm_tile_gradient_beside(g->gradient, at, node);
	const double y = t[1], z = t[2], y0 = 1 - y, z0 = 1 - z, w[4] = {z0 * y0, z * y0, z0 * y, z * y};
	for (int c = 0; c < 3; c++) {
		double side[2];
		for (int x = 0; x < 2; x++)
			side[x] = ((0 + node[x][c] * w[0] + node[x + 2][c] * w[2]) + node[x + 4][c] * w[1]) + node[x + 6][c] * w[3];
		g->value[c][i] = g->factor * (side[0] * (1 - t[0]) + side[1] * t[0]);
	}
}

/* m particles of the stream from p on, m <= PACK. */
static void stretch(struct gather *g, size_t p, size_t m, const struct pm_tile_reach *reach)
{
	uint64_t beyond[WORDS];
	struct pm_target to[3];
	struct pm_column factor[3];
	double *value[3];
	const bool set[3] = {true, true, true};
	g->batch.p = 0, g->batch.m = m;
	for (int d = 0; d < 3; d++) {
		g->batch.x[d] = g->order->x[d].doubles + p, g->batch.next[d] = g->batch.x[d] + PM_TILE_AHEAD;
		value[d] = g->value[d], to[d] = (struct pm_target){.doubles = value[d]}, factor[d] = (struct pm_column){.value = g->factor};
	}
	pm_tile_cic_gather_vectors_near(&g->tile, &g->batch, reach, &(struct pm_tile_results){factor, set, to, NULL, NULL}, beyond);
	for (size_t k = 0; k < WORDS; k++)
		for (uint64_t left = beyond[k]; left; left &= left - 1)
			by_itself(g, p + k * 64 + (size_t)__builtin_ctzll(left), k * 64 + (size_t)__builtin_ctzll(left));
	g->taker->take(g->taker->data, g->order, p, m, NULL, value);
}

static void lots_of(struct gather *g, const uint32_t *lot, size_t n, const struct pm_tile_reach *reach)
{
	const size_t all = g->order->n;
	for (size_t i = 0, many; i < n; i += many) {
		const size_t p = (size_t)lot[i] * LOT;
		for (many = 1; many < PACK / LOT && i + many < n && lot[i + many] == lot[i] + many; many++)
			;
		stretch(g, p, p + many * LOT < all ? many * LOT : all - p, reach);
	}
}

/* A tile's lots; `next` one of those that follow. */
static void tile_of(struct gather *g, const struct lots *l, size_t tile, size_t next)
{
	struct around here, there;
	if (l->begin[tile + 1] == l->begin[tile])
		return;
	around_tile(g->order, tile, &here);
	pm_tile_gradient_of(g->gradient, &here.nodes, NULL, g->tile.nodes);
	if (next < g->order->tiles) {
		around_tile(g->order, next, &there);
		pm_tile_gradient_of_fetch(g->gradient, &there.nodes);
	}
	lots_of(g, l->lot + l->begin[tile], l->begin[tile + 1] - l->begin[tile], &here.reach);
}

static int gather_all(const struct pm_transfer *t, const struct pm_tile_order *plain, const struct lots *l, double factor, const struct pm_tile_taker *taker,
	int threads)
{
	double *nodes = pm_alloc((size_t)threads * PM_VECTOR_NODES, sizeof *nodes);
	if (!nodes)
		return -PM_DATA;
#pragma omp parallel num_threads(threads)
	{
		struct gather g = {.gradient = t->gradient, .order = plain, .taker = taker, .factor = factor, .batch = pm_tile_batch(plain),
			.tile = {.kernel = t->kernel, .components = 3, .nodes = nodes + (size_t)omp_get_thread_num() * PM_VECTOR_NODES}};
#pragma omp for schedule(dynamic, 1)
		for (size_t tile = 0; tile < plain->tiles; tile++)
			tile_of(&g, l, tile, tile + (size_t)omp_get_num_threads());
	}
	pm_free(nodes);
	return 0;
}

int pm_gather_in_place(const struct pm_transfer *t, const struct pm_order_cache *o, double factor, const struct pm_tile_taker *taker, int threads, bool *done)
{
	*done = false;
	if (!t->gradient || !o->order.runs.run || t->components != 3 || t->kernel->width != 2 ||
		!pm_tile_has_vectors(t->grid.dim, t->kernel, 3, o->n / o->order.tiles))
		return 0;
	struct pm_tile_order plain = o->order; /* a lot is in order */
	struct lots l;
	int status = find_homes(&o->order, &l);
	plain.runs = (struct pm_tile_runs){.n = 0};
	if (!status && pays(&plain, &l)) {
		status = gather_all(t, &plain, &l, factor, taker, threads);
		*done = true;
	}
	lots_free(&l);
	return status;
}

