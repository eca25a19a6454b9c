/* Cloud in cell in 3-D, the everyday kernel. Beside each point of a row of cells lie the four points of its square, at y and y + 1, z and z + 1: those of
 * a cell are two squares, one after the other. Spread: a particle is four numbers added to each of its two squares; these are added up once a tile. Gather: it
 * reads two squares, or, where a register holds four, the two points of each row of the block. Eight particles at a time, from records or straight from a
 * stream in the order of tiles, find their places and weights, which are then turned into one vector a particle. Sums of a gather have the order of the loops
 * for all kernels: the same bytes. SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/tile-eight.h"

/* The first square of cells (x fastest). */
PM_SIMD_INLINE pm_simd_int square_of(const struct eight *e)
{
	return ((e->cell[2] << pm_tile_shift[3][1]) + e->cell[1]) * PM_ROW_SQUARES + e->cell[0];
}

PM_SIMD_INLINE void add_to_squares(double *restrict squares, int32_t square, const double *yz, double x)
{
	pm_simd4_at *to = (pm_simd4_at *)(squares + (size_t)(uint32_t)square * PM_SQUARE);
	const pm_simd4_at four = *(const pm_simd4_at *)yz, far = pm_simd4_here(x); /* one load, where x and 1 - x as numbers would be spread twice */
	to[0] += four * (1 - far);
	to[1] += four * far;
}

/* m particles are added as STREAMS streams in turn, of of_each(m) particles each, then the rest: in a stream that is in the order of cells a sum would wait for
 * the one before it. */
enum { STREAMS = 4, LOT = STREAMS * PM_SIMD_WIDTH };
PM_SIMD_INLINE size_t of_each(size_t m) { return m / (STREAMS * 8) * 8; }

/* What a lot of particles, a register of each stream, adds to its squares. */
struct shares {
	double yz[LOT * 4] __attribute__((aligned(64))), x[LOT] __attribute__((aligned(64)));
	int32_t at[LOT] __attribute__((aligned(64)));
};

PM_SIMD_INLINE void share(pm_simd_int square, const pm_simd distance[3], pm_simd strength, size_t place, struct shares *to)
{
	const pm_simd low = (1 - distance[2]) * strength, high = distance[2] * strength, y = distance[1], below = 1 - y;
	*(pm_simd_int_at *)(to->at + place) = square;
	pm_simd_store(to->x + place, distance[0]);
	turn_out((const pm_simd[]){low * below, high * below, low * y, high * y}, to->yz + 4 * place);
}

PM_SIMD_INLINE void add_share(const struct shares *s, size_t place, size_t lane, double *squares)
{
	add_to_squares(squares, s->at[place + lane], s->yz + 4 * place + turned(lane), s->x[place + lane]);
}

/* Part k of STREAMS of a lot. */
PM_SIMD_INLINE void add_part(const struct shares *s, size_t k, double *squares)
{
	enum { part = PM_SIMD_WIDTH / STREAMS };
	_Static_assert((int)part * STREAMS == PM_SIMD_WIDTH || !PM_TILE_CIC_EIGHT, "a lot has whole parts");
	PM_SIMD_UNROLL
	for (size_t lane = k * part; lane < k * part + part; lane++) {
		PM_SIMD_UNROLL
		for (size_t stream = 0; stream < STREAMS; stream++)
			add_share(s, stream * PM_SIMD_WIDTH, lane, squares);
	}
}

/* Where particles come from: a batch and its strengths, or the records of t. Each loop has its own, whose lanes it need not load again when it has
 * stored. */
struct source {
	const struct pm_tile *t;
	struct pm_tile_batch batch;
	const double *q;
	pm_simd_int cells[3];   /* find_in_batch, where outside is asked for: all bits of cells within the tile */
	pm_simd_bits differ[3]; /* find_assumed: bits in which cells are not `big` */
	pm_simd down[3], first; /* find_assumed: big less the tile's first cell; squares of whole planes and rows before it */
};
/* Shares of a register of particles, from i on, to a place in a lot. */
typedef void finder(struct source *s, size_t i, size_t place, struct shares *to);

/* True where a finder looks at nothing. */
PM_SIMD_INLINE bool all_inside(const struct source *s)
{
	pm_simd_int beyond = {0};
	pm_simd_bits differ = {0};
	for (int d = 0; d < 3; d++)
		beyond |= s->cells[d] >> pm_tile_shift[3][d], differ |= s->differ[d] >> pm_tile_shift[3][d];
	return !pm_simd_any_bit(differ) && !pm_simd_int_others(beyond, 0);
}

/* The streams of m particles: a lot is added, part by part, while the next one is found (0.9 of a spread at 8 a cell). A lot is looked at before it is added.
 * False: one is beyond the tile, and not all are added. */
PM_SIMD_INLINE bool add_streams(struct source *s, finder *find, size_t m, double *squares)
{
	const size_t each = of_each(m);
	struct shares lots[2], *last = lots;
	bool inside = true;
	if (!each)
		return true;
	for (size_t i = 0; i < each && inside; i += PM_SIMD_WIDTH) {
		struct shares *here = &lots[i / PM_SIMD_WIDTH % 2];
		PM_SIMD_UNROLL
		for (size_t k = 0; k < STREAMS; k++) {
			find(s, i + k * each, k * PM_SIMD_WIDTH, here);
			if (i)
				add_part(last, k, squares);
		}
		inside = all_inside(s), last = here;
	}
	for (size_t k = 0; inside && k < STREAMS; k++)
		add_part(last, k, squares);
	return inside;
}

/* Those behind the streams, found and then added; false as there. */
PM_SIMD_INLINE bool add_rest(struct source *s, finder *find, size_t m, double *squares)
{
	struct shares lot;
	for (size_t from = STREAMS * of_each(m), some; from < m; from += some) {
		some = m - from < LOT ? m - from : LOT;
		for (size_t i = 0; i < some; i += PM_SIMD_WIDTH)
			find(s, from + i, i, &lot);
		if (!all_inside(s))
			return false;
		for (size_t i = 0; i < some; i++)
			add_share(&lot, i / PM_SIMD_WIDTH * PM_SIMD_WIDTH, i % PM_SIMD_WIDTH, squares);
	}
	return true;
}

PM_SIMD_INLINE void find_in_batch(struct source *s, size_t i, size_t place, struct shares *to)
{
	const struct eight e = find_eight(s->t, &s->batch, i);
	pm_simd strength;
	if (i + PM_SIMD_WIDTH <= s->batch.m) {
		strength = pm_simd_load_any(s->q + i);
	} else {
		double few[PM_SIMD_WIDTH] = {0};
		memcpy(few, s->q + i, (s->batch.m - i) * sizeof *s->q);
		strength = pm_simd_load_any(few);
	}
	__builtin_prefetch(s->batch.next_value + i, 0, 2);
	if (s->batch.outside)
		for (int d = 0; d < 3; d++)
			s->cells[d] |= e.cell[d];
	share(square_of(&e), e.distance, strength, place, to);
}

#if PM_SIMD_DOWN
/* big: where each number between it and twice it is whole, and the last bits count. Squares from row to row, from plane to plane. */
static const double big = 0x1p52;
static const double y_apart = PM_ROW_SQUARES, z_apart = PM_PLANE_SQUARES;

/* May a particle that is in the tile's cells be anywhere but where its position says? */
static bool is_plain(const struct pm_tile *t, const struct pm_tile_batch *b)
{
	bool plain = true;
	for (int d = 0; d < 3; d++) {
		const struct pm_axis *a = &b->order->axes[d];
		plain = plain && a->periodic && a->half == 0 && (size_t)t->cell[d] + ((size_t)1 << pm_tile_shift[3][d]) <= a->count;
	}
	return plain;
}

/* Where the tile is plain, and each particle is assumed to be in it: as find_eight finds them, but that the sum that rounds down to a cell also holds its
 * number, and nobody looks whether a particle is beyond the box: there it is beyond the tile. Positions are fetched into the second-level cache, as the first
 * holds squares (0.96 of a spread at 8 a cell). */
PM_SIMD_INLINE void find_assumed(struct source *s, size_t i, size_t place, struct shares *to)
{
	const struct pm_tile_batch *b = &s->batch;
	pm_simd cell[3], whole[3], distance[3];
	PM_SIMD_UNROLL
	for (int d = 0; d < 3; d++) {
		const struct pm_axis_lanes *a = &b->lanes[d];
		__builtin_prefetch(b->next[d] + i, 0, 2);
		const pm_simd u = pm_simd_divide(pm_simd_load_any(b->x[d] + i) - a->lo, a->h, a->inverse) + a->add;
		cell[d] = pm_simd_add_down(u, s->down[d]);
		whole[d] = cell[d] - s->down[d], distance[d] = u - whole[d];
		s->differ[d] |= (pm_simd_bits)cell[d] ^ (pm_simd_bits)pm_simd_all(big);
	}
	__builtin_prefetch(b->next_value + i, 0, 2);
	const pm_simd row = pm_simd_fma(pm_simd_all(y_apart), whole[1], cell[0] - s->first), square = pm_simd_fma(pm_simd_all(z_apart), whole[2], row);
	share(pm_simd_low_halves(square), distance, pm_simd_load_any(s->q + i), place, to);
}

static bool add_assumed(const struct pm_tile *t, const struct pm_tile_batch *b, const double *q)
{
	struct source s = {.t = t, .batch = *b, .q = q};
	s.first = pm_simd_all(y_apart * (double)t->cell[1] + z_apart * (double)t->cell[2]);
	for (int d = 0; d < 3; d++)
		s.down[d] = pm_simd_all(big - (double)t->cell[d]);
	return add_streams(&s, find_assumed, b->m, t->squares);
}
#else
static bool is_plain(const struct pm_tile *t, const struct pm_tile_batch *b) { return (void)t, (void)b, false; }
static bool add_assumed(const struct pm_tile *t, const struct pm_tile_batch *b, const double *q) { return (void)t, (void)b, (void)q, false; }
#endif

static bool add_batch(const struct pm_tile *t, const struct pm_tile_batch *b, const double *q)
{
	struct source s = {.t = t, .batch = *b, .q = q};
	return add_streams(&s, find_in_batch, b->m, t->squares);
}

static bool add_rest_of_batch(const struct pm_tile *t, const struct pm_tile_batch *b, const double *q)
{
	struct source s = {.t = t, .batch = *b, .q = q};
	return add_rest(&s, find_in_batch, b->m, t->squares);
}

void pm_tile_cic_spread(const struct pm_tile *t, const struct pm_tile_batch *b, const double *q)
{
	const bool inside = b->outside && is_plain(t, b) ? add_assumed(t, b, q) : add_batch(t, b, q), rest = STREAMS * of_each(b->m) < b->m;
	if (!inside || (rest && !add_rest_of_batch(t, b, q)))
		__atomic_store_n(b->outside, true, __ATOMIC_RELAXED);
}

PM_SIMD_INLINE void find_of_records(struct source *s, size_t i, size_t place, struct shares *to)
{
	const struct pm_tile *t = s->t;
	pm_simd strength;
	const struct eight e = find_eight_of_records(t, i, &strength);
	if (t->value != 3) {
		double few[PM_SIMD_WIDTH];
		for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
			few[l] = t->records[(i + (i + l < t->count ? l : 0)) * (size_t)t->stride + (size_t)t->value];
		strength = pm_simd_load_any(few);
	}
	share(square_of(&e), e.distance, strength, place, to);
}

void pm_tile_cic_spread_eight(const struct pm_tile *all)
{
	struct pm_tile t = *all;
	struct source s = {.t = &t};
	for (size_t from = 0; from < all->count; from += PM_TILE_ORDER_PACK) {
		t.records = all->records + from * (size_t)t.stride;
		t.count = all->count - from < PM_TILE_ORDER_PACK ? all->count - from : PM_TILE_ORDER_PACK;
		(void)add_streams(&s, find_of_records, t.count, t.squares); /* records are in their tile: nothing is looked at */
		(void)add_rest(&s, find_of_records, t.count, t.squares);
	}
}

/* A particle by itself: the same, where a register holds fewer than four. */
PM_SIMD_INLINE void add_record(const struct pm_tile *t, const double *record)
{
	const pm_simd4_at one_y = {1, 1, 0, 0}, one_z = {1, 0, 1, 0};
	const pm_simd4_int_at first = {(int32_t)t->cell[0], (int32_t)t->cell[1], (int32_t)t->cell[2], 0};
	double distance[4], yz[4];
	int32_t cell[4];
	pm_simd4_at u = *(const pm_simd4_at *)record;
	pm_simd4_int_at floor_u = __builtin_convertvector(u, pm_simd4_int_at);
	*(pm_simd4_at *)distance = u - __builtin_convertvector(floor_u, pm_simd4_at);
	*(pm_simd4_int_at *)cell = floor_u - first;
	*(pm_simd4_at *)yz = (one_z + (1 - 2 * one_z) * distance[2]) * record[t->value] * (one_y + (1 - 2 * one_y) * distance[1]);
	add_to_squares(t->squares, ((cell[2] << pm_tile_shift[3][1]) + cell[1]) * PM_ROW_SQUARES + cell[0], yz, distance[0]);
}

void pm_tile_cic_spread_records(const struct pm_tile *t)
{
	const size_t stride = (size_t)t->stride;
	for (size_t from = 0, m; from < t->count; from += m) {
		m = t->count - from < PM_TILE_ORDER_PACK ? t->count - from : PM_TILE_ORDER_PACK;
		const size_t each = of_each(m);
		for (size_t i = 0; i < STREAMS * each; i++)
			add_record(t, t->records + (from + i % STREAMS * each + i / STREAMS) * stride);
		for (size_t i = STREAMS * each; i < m; i++)
			add_record(t, t->records + (from + i) * stride);
	}
}

typedef pm_simd8_at eight_at;
typedef pm_simd4_at four_at;

/* Square i of a row, with what the row before has left in before[point][2], to two rows of the block; y + 1 is left for the next. Leaves it zero. */
PM_SIMD_INLINE void add_square(size_t i, double *restrict squares, double *restrict before, bool first, double *restrict low, double *restrict high)
{
	double *c = squares + PM_SQUARE * i, *left = before + 2 * i;
	low[i] = first ? c[0] + left[0] : low[i] + (c[0] + left[0]);
	high[i] = c[1] + left[1];
	left[0] = c[2], left[1] = c[3];
	*(pm_simd4_at *)c = (pm_simd4_at){0};
}

/* Eight or four of them from i on. */
PM_SIMD_INLINE void add_eight_squares(size_t i, double *restrict squares, double *restrict before, bool first, double *restrict low, double *restrict high)
{
	const eight_at zero = {0};
	eight_at here[2], *left = (eight_at *)(before + 2 * i), *c = (eight_at *)(squares + PM_SQUARE * i);
	PM_SIMD_UNROLL
	for (size_t k = 0; k < 2; k++) {
		const eight_at a = c[2 * k], b = c[2 * k + 1];
		c[2 * k] = c[2 * k + 1] = zero;
		here[k] = __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13) + left[k];
		left[k] = __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15);
	}
	eight_at even = __builtin_shufflevector(here[0], here[1], 0, 2, 4, 6, 8, 10, 12, 14);
	if (!first)
		even += *(eight_at *)(low + i);
	*(eight_at *)(low + i) = even;
	*(eight_at *)(high + i) = __builtin_shufflevector(here[0], here[1], 1, 3, 5, 7, 9, 11, 13, 15);
}

PM_SIMD_INLINE void add_four_squares(size_t i, double *restrict squares, double *restrict before, bool first, double *restrict low, double *restrict high)
{
	const four_at zero = {0};
	four_at here[2], *left = (four_at *)(before + 2 * i), *c = (four_at *)(squares + PM_SQUARE * i);
	PM_SIMD_UNROLL
	for (size_t k = 0; k < 2; k++) {
		const four_at a = c[2 * k], b = c[2 * k + 1];
		c[2 * k] = c[2 * k + 1] = zero;
		here[k] = __builtin_shufflevector(a, b, 0, 1, 4, 5) + left[k];
		left[k] = __builtin_shufflevector(a, b, 2, 3, 6, 7);
	}
	four_at even = __builtin_shufflevector(here[0], here[1], 0, 2, 4, 6);
	if (!first)
		even += *(four_at *)(low + i);
	*(four_at *)(low + i) = even;
	*(four_at *)(high + i) = __builtin_shufflevector(here[0], here[1], 1, 3, 5, 7);
}

/* What the last row of a plane has left. */
static void add_left(size_t n, const double *restrict before, bool first, double *restrict low, double *restrict high)
{
	for (size_t i = 0; i < n; i++) {
		low[i] = first ? before[2 * i] : low[i] + before[2 * i];
		high[i] = before[2 * i + 1];
	}
}

void pm_tile_cic_fold(const struct pm_tile *t, const size_t cells[3])
{
	const bool eight = (int)PM_SIMD_PART == 8;
	const size_t row = (size_t)pm_block_row[3], plane = row * (size_t)pm_block_rows[3], n = cells[0] + 1;
	double before[PM_ROW_SQUARES * 2] __attribute__((aligned(64)));
	for (size_t z = 0; z < cells[2]; z++) {
		memset(before, 0, sizeof before);
		for (size_t y = 0; y < cells[1]; y++) {
			double *low = t->block + z * plane + y * row, *squares = pm_row_squares(t->squares, y, z);
			size_t i = 0;
			for (; eight && i + 8 <= n; i += 8)
				add_eight_squares(i, squares, before, z == 0, low, low + plane);
			for (; i + 4 <= n; i += 4)
				add_four_squares(i, squares, before, z == 0, low, low + plane);
			for (; i < n; i++)
				add_square(i, squares, before, z == 0, low, low + plane);
		}
		add_left(n, before, z == 0, t->block + z * plane + cells[1] * row, t->block + (z + 1) * plane + cells[1] * row);
	}
}

void pm_tile_cic_unfold(const double *block, const size_t cells[3], double *squares)
{
	const size_t row = (size_t)pm_block_row[3], plane = row * (size_t)pm_block_rows[3];
	for (size_t z = 0; z < cells[2]; z++)
		for (size_t y = 0; y < cells[1]; y++) {
			const double *low = block + z * plane + y * row;
			double *to = pm_row_squares(squares, y, z);
			size_t x = 0;
			for (; x + PM_SIMD_WIDTH <= cells[0] + 1; x += PM_SIMD_WIDTH) {
				const double *at = low + x;
				pm_simd_store_columns(to + x * PM_SQUARE, (const pm_simd[]){pm_simd_load_any(at), pm_simd_load_any(at + plane),
					pm_simd_load_any(at + row), pm_simd_load_any(at + plane + row)});
			}
			for (; x <= cells[0]; x++)
				*(four_at *)(to + x * PM_SQUARE) = (four_at){low[x], low[x + plane], low[x + row], low[x + plane + row]};
		}
}

/* The two squares of eight cells to eight vectors, one a point. */
PM_SIMD_INLINE void turn_squares(const double *squares, const int32_t *at, pm_simd to[8])
{
	PM_SIMD_UNROLL
	for (int half = 0; half < 2; half++) {
		const double *from[PM_SIMD_WIDTH];
		pm_simd v[4];
		PM_SIMD_UNROLL
		for (int l = 0; l < PM_SIMD_WIDTH; l++)
			from[l] = squares + PM_SQUARE * ((size_t)(uint32_t)at[l] + (size_t)half);
		PM_SIMD_UNROLL
		for (size_t k = 0; k < 4; k++)
			v[k] = pm_simd_fours(from, k);
		pm_simd_turn(v, to + 4 * half);
	}
}

PM_SIMD_INLINE pm_simd_int place_of(const struct eight *e) { return PM_TILE_CIC_SQUARES ? square_of(e) : node_of(e); }

/* Weights of four rows, [y*2 + z]; x of the two halves of each. */
struct rows {
	pm_simd w[4], x, x0;
	const int32_t *at;
};

PM_SIMD_INLINE struct rows rows_of(const struct places *p, size_t i)
{
	const pm_simd x = pm_simd_load(p->distance[0] + i), y = pm_simd_load(p->distance[1] + i), z = pm_simd_load(p->distance[2] + i), y0 = 1 - y, z0 = 1 - z;
	return (struct rows){.w = {z0 * y0, z * y0, z0 * y, z * y}, .x = x, .x0 = 1 - x, .at = p->at + i};
}

/* The two points of each of four rows of the block. */
PM_SIMD_INLINE void load_rows(const double *block, const int32_t *at, pm_simd to[8])
{
	enum { row = PM_BLOCK_ROW, plane = PM_BLOCK_ROW * PM_BLOCK_ROWS };
	PM_SIMD_UNROLL
	for (size_t some = 0; some < PM_SIMD_WIDTH; some += 4) {
		const double *from[4];
		PM_SIMD_UNROLL
		for (size_t l = 0; l < 4; l++)
			from[l] = block + (size_t)(uint32_t)at[some + l];
		PM_SIMD_UNROLL
		for (size_t k = 0; k < 4; k++) {
			pm_simd4_at pair[2];
			pm_simd4_pairs(from, k / 2 * row + k % 2 * plane, pair);
			memcpy((double *)&to[k] + some, &pair[0], sizeof pair[0]);
			memcpy((double *)&to[k + 4] + some, &pair[1], sizeof pair[1]);
		}
	}
}

/* A component at eight particles: in the order of the loop for all kernels, rows y, then z. from: the squares of its cells, or its block. */
PM_SIMD_INLINE pm_simd value_of(const struct rows *r, const double *from)
{
	pm_simd v[8];
	if (PM_TILE_CIC_SQUARES)
		turn_squares(from, r->at, v);
	else
		load_rows(from, r->at, v);
	/* 0 +: as the loop begins, so that no sum is -0 */
	const pm_simd below = ((0 + v[0] * r->w[0] + v[2] * r->w[2]) + v[1] * r->w[1]) + v[3] * r->w[3];
	const pm_simd above = ((0 + v[4] * r->w[0] + v[6] * r->w[2]) + v[5] * r->w[1]) + v[7] * r->w[3];
	return below * r->x0 + above * r->x;
}

PM_SIMD_INLINE const double *component(const struct pm_tile *t, int c)
{
	return PM_TILE_CIC_SQUARES ? t->squares + (size_t)c * PM_TILE_SQUARES : t->block + (size_t)c * PM_BLOCK_MOST;
}

bool pm_tile_cic_gather(const struct pm_tile *t, const struct pm_tile_batch *batch, const struct pm_tile_results *r)
{
	struct delivery to[PM_COMPONENTS];
	struct places places;
	pm_simd nothing = {0};
	for (int c = 0; c < t->components; c++)
		to[c] = delivery_of(r, c);
	for (size_t from = 0, end; from < batch->m; from = end) {
		end = find_places(3, t, batch, from, place_of, &places);
		for (size_t i = from; i < end; i += PM_SIMD_WIDTH) {
			const struct rows rows = rows_of(&places, i - from);
			const size_t n = end - i < PM_SIMD_WIDTH ? end - i : PM_SIMD_WIDTH, p = batch->p + i;
			if (t->components == 1) { /* not in the loop, before which gcc works out the addresses of eight particles and keeps them in memory */
				deliver_eight(value_of(&rows, component(t, 0)), n, &to[0], p, &nothing);
				continue;
			}
			for (int c = 0; c < t->components; c++)
				deliver_eight(value_of(&rows, component(t, c)), n, &to[c], p, &nothing);
		}
	}
	return !pm_simd_outside(nothing, (pm_simd){0}, (pm_simd){0});
}

void pm_tile_cic_gather_eight(const struct pm_tile *t)
{
	const size_t to = (size_t)t->to;
	for (size_t i = 0; i < t->count; i += PM_SIMD_WIDTH) {
		pm_simd fourth;
		const struct eight e = find_eight_of_records(t, i, &fourth);
		struct places places;
		put_eight(3, &e, place_of, 0, &places);
		const struct rows rows = rows_of(&places, 0);
		const size_t n = t->count - i < PM_SIMD_WIDTH ? t->count - i : PM_SIMD_WIDTH;
		if (t->components == 1) {
			const pm_simd v = value_of(&rows, component(t, 0));
			for (size_t l = 0; l < n; l++)
				t->results[(i + l) * to] = v[l];
			continue;
		}
		for (int c = 0; c < t->components; c += 4) {
			const int some = t->components - c < 4 ? t->components - c : 4;
			pm_simd v[4];
			double out[PM_SIMD_WIDTH * 4] __attribute__((aligned(64)));
			PM_SIMD_UNROLL
			for (int k = 0; k < 4; k++)
				v[k] = k < some ? value_of(&rows, component(t, c + k)) : fourth;
			turn_out(v, out);
			for (size_t l = 0; l < n; l++) {
				double *result = t->results + (i + l) * to + c;
				const double *from = out + turned(l);
				if (to == 4 && some > 2) /* the fourth may be written too: nothing else is there */
					*(pm_simd4_at *)result = *(const pm_simd4_at *)from;
				else
					for (int k = 0; k < some; k++)
						result[k] = from[k];
			}
		}
	}
}
