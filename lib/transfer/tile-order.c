/* A stable counting sort of particles into tiles of cells: count per chunk of the stream, add up, move the records. Stability makes the result
 * independent of the number of chunks, which is the number of threads. Particles that are already in the order of tiles are not moved, and of those that
 * nearly are only the runs are sorted (tile-runs.h).
 * Cost: two to four passes over the positions, one over the rest; none where the order is assumed.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "transfer/tile-order.h"

/* ahead: of a later record the end is prefetched, for it begins where the one before ends; line: doubles per cache line; many: a change of tile in fewer
 * particles takes longer than these alone */
enum { batch = PM_TILE_ORDER_PACK, ahead = 16, line = 8, many = 16, begun = 256 /* eights before it is asked whether there are too many */ };

static size_t chunk_from(const struct pm_tile_order *o, int chunk) { return pm_tile_chunk(o->n, o->chunks, chunk); }
static size_t chunk_to(const struct pm_tile_order *o, int chunk) { return pm_tile_chunk(o->n, o->chunks, chunk + 1); }

void pm_tile_ways(double dt, double h, size_t m, const double *restrict x, const double *restrict v, double *restrict length)
{
	const pm_simd steps = pm_simd_all(dt), cells = pm_simd_all(h), inverse = pm_simd_all(1 / h);
	size_t i = 0;
	for (; i + PM_SIMD_WIDTH <= m; i += PM_SIMD_WIDTH) {
		const pm_simd a = pm_simd_load_any(x + i), b = a + steps * pm_simd_load_any(v + i);
		pm_simd_store_any(length + i, pm_simd_divide(b - a, cells, inverse));
	}
	if (i < m) { /* as the others to the last bit, wherever a piece of the stream ends */
		pm_simd a = pm_simd_all(0), b = a;
		memcpy(&a, x + i, (m - i) * sizeof *x), memcpy(&b, v + i, (m - i) * sizeof *v);
		b = a + steps * b;
		a = pm_simd_divide(b - a, cells, inverse);
		memcpy(length + i, &a, (m - i) * sizeof *length);
	}
}

/* u[d][0..m-1] of the particles from p on; false if there are strays (-1). */
static bool locate(const struct pm_tile_order *o, size_t p, size_t m, double u[3][batch])
{
	bool all = true;
	double few[batch];
	for (int d = 0; d < o->dim; d++)
		all &= pm_axis_locate_many(&o->axes[d], m, pm_column_take(&o->x[d], p, m, few), u[d]);
	return all;
}

static void find_strays(const struct pm_tile_order *o, size_t p, size_t m, double u[3][batch], uint32_t *tile, struct pm_strays *strays)
{
	for (size_t i = 0; i < m; i++)
		for (int d = 0; d < o->dim; d++)
			if (u[d][i] < 0) {
				tile[i] = (uint32_t)o->tiles;
				double at[3] = {0};
				for (int e = 0; e < o->dim; e++)
					at[e] = pm_column_at(&o->x[e], p + i);
				pm_strays_note_at(strays, p + i, at, d);
				break;
			}
}

/* u is not negative (strays are handled later), so the cast equals floor. */
static void find_tiles(const struct pm_tile_order *o, size_t m, double u[3][batch], uint32_t *restrict tile)
{
	const int *shift = pm_tile_shift[o->dim];
	for (size_t i = 0; i < m; i++)
		tile[i] = (uint32_t)((int32_t)u[0][i] >> shift[0]);
	for (int d = 1; d < o->dim; d++) {
		uint32_t step = d == 1 ? o->across[0] : o->across[0] * o->across[1];
		for (size_t i = 0; i < m; i++)
			tile[i] += step * (uint32_t)((int32_t)u[d][i] >> shift[d]);
	}
}

/* The tiles of m particles at x[dim] in eights, straight from the stream. False if any of them is outside the range of the
 * lanes. */
PM_SIMD_INLINE bool tiles_of(int dim, const struct pm_tile_order *o, const struct pm_axis_lanes *lanes, const double *const x[3], size_t m, uint32_t *tile)
{
	const int *shift = pm_tile_shift[dim];
	const uint32_t across = o->across[0], layer = o->across[0] * o->across[1];
	struct pm_axis_lanes mine[3]; /* what is stored here might be those of the caller, and they would be loaded again and again */
	unsigned any = 0;
	PM_SIMD_UNROLL
	for (int d = 0; d < dim; d++)
		mine[d] = lanes[d];
	for (size_t i = 0; i < m; i += PM_SIMD_WIDTH) {
		pm_simd_int cell;
		pm_simd_uint at = {0}; /* what strays have is not used */
		PM_SIMD_UNROLL
		for (int d = 0; d < dim; d++) {
			unsigned outside;
			const pm_simd a = pm_simd_load_any(x[d] + i);
			pm_simd_split(pm_axis_locate_eight(&mine[d], a, &outside), &cell);
			pm_tile_fetch_ahead(x[d] + i);
			at += (pm_simd_uint)(cell >> shift[d]) * (d == 0 ? 1 : d == 1 ? across : layer);
			any |= outside;
		}
		*(pm_simd_int_at *)(tile + i) = (pm_simd_int)at;
	}
	return !any;
}

/* Whether no particle is outside the range of the lanes. */
static bool all_inside(const struct pm_tile_order *o, const struct pm_axis_lanes *lanes, size_t p, size_t m)
{
	unsigned any = m % PM_SIMD_WIDTH != 0;
	double few[batch];
	for (int d = 0; d < o->dim && !any; d++) {
		const struct pm_axis_lanes a = lanes[d];
		const double *x = pm_column_take(&o->x[d], p, m, few);
		for (size_t i = 0; i < m; i += PM_SIMD_WIDTH) {
			unsigned outside;
			pm_tile_fetch_ahead(x + i);
			pm_axis_locate_eight(&a, pm_simd_load_any(x + i), &outside);
			any |= outside;
		}
	}
	return !any;
}

/* The tiles of particles none of which is outside the range of the lanes; else false. */
static bool usual_tiles(const struct pm_tile_order *o, const struct pm_axis_lanes *lanes, size_t p, size_t m, double u[3][batch], uint32_t *tile)
{
	const double *x[3] = {NULL};
	if ((int)PM_SIMD_PART != (int)PM_SIMD_WIDTH || m % PM_SIMD_WIDTH != 0)
		return false;
	for (int d = 0; d < o->dim; d++)
		x[d] = pm_column_take(&o->x[d], p, m, u[d]);
	return o->dim == 1 ? tiles_of(1, o, lanes, x, m, tile) : o->dim == 2 ? tiles_of(2, o, lanes, x, m, tile) : tiles_of(3, o, lanes, x, m, tile);
}

static bool batch_tiles(const struct pm_tile_order *o, const struct pm_axis_lanes *lanes, size_t p, size_t m, uint32_t *tile)
{
	double u[3][batch];
	if (o->tiles == 1) { /* any particle that is no stray is in order */
		memset(tile, 0, m * sizeof *tile);
		return all_inside(o, lanes, p, m) || locate(o, p, m, u);
	}
	if (usual_tiles(o, lanes, p, m, u, tile))
		return true;
	if (!locate(o, p, m, u))
		return false;
	find_tiles(o, m, u, tile);
	return true;
}

/* One tile is all of a periodic box: no particle is outside, wherever it is. */
static bool is_whole_box(const struct pm_tile_order *o)
{
	bool whole = o->finite && o->tiles == 1;
	for (int d = 0; d < o->dim; d++)
		whole = whole && o->axes[d].periodic;
	return whole;
}

/* Counts the tiles of a chunk as long as it is in order and without strays: then the tile of each particle need not be kept. ends: the first tile and the
 * last. False where the order is broken; the counts are then void. */
static bool count_in_order(struct pm_tile_order *o, int chunk, uint32_t ends[2])
{
	size_t *count = o->cursor + (size_t)(chunk + 1) * (o->tiles + 1);
	struct pm_axis_lanes lanes[3];
	uint32_t tile[1 + batch] = {0};
	for (int d = 0; d < o->dim; d++)
		lanes[d] = pm_axis_lanes(&o->axes[d]);
	memset(count, 0, (o->tiles + 1) * sizeof *count);
	if (is_whole_box(o)) {
		count[0] = chunk_to(o, chunk) - chunk_from(o, chunk);
		ends[0] = ends[1] = 0;
		return true;
	}
	for (size_t p = chunk_from(o, chunk), to = chunk_to(o, chunk); p < to; p += batch) {
		size_t m = to - p < batch ? to - p : batch;
		uint32_t falls = 0;
		if (!batch_tiles(o, lanes, p, m, tile + 1))
			return false;
		for (size_t i = 0; i < m; i++)
			falls |= tile[i + 1] < tile[i];
		if (falls)
			return false;
		if (tile[1] == tile[m])
			count[tile[1]] += m;
		else
			for (size_t i = 1; i <= m; i++)
				count[tile[i]]++;
		if (p == chunk_from(o, chunk))
			ends[0] = tile[1];
		ends[1] = tile[0] = tile[m];
	}
	return true;
}

static void any_tiles(const struct pm_tile_order *o, const struct pm_axis_lanes *lanes, size_t p, size_t m, uint32_t *tile, struct pm_strays *strays)
{
	double u[3][batch];
	if (usual_tiles(o, lanes, p, m, u, tile))
		return;
	const bool all = locate(o, p, m, u);
	find_tiles(o, m, u, tile);
	if (!all)
		find_strays(o, p, m, u, tile, strays);
}

/* Counts the tiles of a chunk, and finds its runs; false where there are too many for particles to stay. */
static bool find_chunk(struct pm_tile_order *o, int chunk, size_t stays, struct pm_tile_finds *finds, struct pm_strays *strays)
{
	struct pm_tile_finds mine = *finds, *const f = &mine; /* those of other threads lie in the same line of the cache */
	size_t *count = o->cursor + (size_t)(chunk + 1) * (o->tiles + 1);
	struct pm_axis_lanes lanes[3];
	uint32_t tile[batch];
	for (int d = 0; d < o->dim; d++)
		lanes[d] = pm_axis_lanes(&o->axes[d]);
	memset(count, 0, (o->tiles + 1) * sizeof *count);
	*strays = (struct pm_strays){.count = 0};
	for (size_t from = chunk_from(o, chunk), p = from, to = chunk_to(o, chunk); p < to; p += batch) {
		const size_t m = to - p < batch ? to - p : batch, before = f->n;
		any_tiles(o, lanes, p, m, tile, strays);
		for (size_t i = 0; i < m; i += PM_TILE_RUN)
			if (!pm_tile_runs_find(f, p + i, m - i < PM_TILE_RUN ? m - i : PM_TILE_RUN, tile + i))
				return false;
		for (size_t k = before; k < f->n; k++)
			count[f->found[k].tile] += pm_simd_bits_of_word(f->found[k].members);
		if (f->eights > begun + (p + m - from) / PM_TILE_RUN * stays)
			return false;
	}
	*finds = mine;
	return true;
}

/* How many of the m particles behind the one at tile[0] have another tile than the one before. */
static size_t changes_of(const uint32_t *tile, size_t m)
{
	uint32_t changes = 0;
	for (size_t i = 0; i < m; i++)
		changes += tile[i] != tile[i + 1];
	return changes;
}

/* The first particle behind i, before end, in another tile; or end. */
static size_t other(const uint32_t *tile, size_t i, size_t end)
{
	const int32_t here = (int32_t)tile[i++];
	for (; i + PM_SIMD_WIDTH <= end; i += PM_SIMD_WIDTH) {
		const unsigned others = pm_simd_int_others(*(const pm_simd_int_at *)(tile + i), here);
		if (others)
			return i + (size_t)__builtin_ctz(others);
	}
	while (i < end && (int32_t)tile[i] == here)
		i++;
	return i;
}

/* Counts, and keeps the tile of each. */
static void count_chunk(struct pm_tile_order *o, int chunk, struct pm_strays *strays)
{
	size_t *count = o->cursor + (size_t)(chunk + 1) * (o->tiles + 1);
	struct pm_axis_lanes lanes[3];
	for (int d = 0; d < o->dim; d++)
		lanes[d] = pm_axis_lanes(&o->axes[d]);
	memset(count, 0, (o->tiles + 1) * sizeof *count);
	*strays = (struct pm_strays){.count = 0};
	for (size_t p = chunk_from(o, chunk), to = chunk_to(o, chunk); p < to; p += batch) {
		const size_t m = to - p < batch ? to - p : batch;
		any_tiles(o, lanes, p, m, o->tile + p, strays);
		if (changes_of(o->tile + p, m - 1) > m / many)
			for (size_t i = p; i < p + m; i++)
				count[o->tile[i]]++;
		else
			for (size_t i = p, end; i < p + m; i = end) { /* a counter that is raised one by one waits for itself */
				end = other(o->tile, i, p + m);
				count[o->tile[i]] += end - i;
			}
	}
}

/* Counts become the first place of each chunk in each tile. Row 0 is that of chunk 0 for good; row c+1 is used up by chunk c and is then
 * what chunk c+1 began with. */
static void add_up(struct pm_tile_order *o)
{
	size_t at = 0, columns = o->tiles + 1;
	for (size_t t = 0; t < columns; t++) {
		o->begin[t] = o->cursor[t] = at;
		for (int chunk = 0; chunk < o->chunks; chunk++) {
			size_t *cell = &o->cursor[(size_t)(chunk + 1) * columns + t], count = *cell;
			*cell = at;
			at += count;
		}
	}
	o->begin[columns] = at;
}

/* Numbers of m particles of a chunk from p on that ends at `end`: value[n][m], and where the stream has those of the next ones, to be fetched. */
struct moved {
	size_t p, m, end;
	const double *value[PM_COMPONENTS + 3], *next[PM_COMPONENTS + 3];
};

/* One by one, from the i-th on. */
static void move_rest(const struct pm_tile_order *o, const struct moved *b, size_t i, size_t *cursor)
{
	const size_t stride = (size_t)o->stride;
	const int n = o->dim + o->nvalues;
	for (; i < b->m; i++) {
		const size_t p = b->p + i;
		const uint32_t soon = o->tile[p + ahead < b->end ? p + ahead : p];
		double *record = o->records + stride * cursor[o->tile[p]]++;
		__builtin_prefetch(o->records + stride * cursor[soon] + n - 1, 1);
		for (int c = 0; c < n; c++) {
			if (i % line == 0)
				__builtin_prefetch(b->next[c] + i);
			record[c] = b->value[c][i];
		}
	}
}

/* Lanes 4 half..4 half + 3: a record of four numbers, or the first two of one. */
PM_SIMD_INLINE void put_record(int n, pm_simd v, size_t half, double *record)
{
#ifdef PM_SIMD_EIGHT
	const pm_simd4_at four = half ? __builtin_shufflevector(v, v, 4, 5, 6, 7) : __builtin_shufflevector(v, v, 0, 1, 2, 3);
#else
	const pm_simd4_at four = v;
	(void)half;
#endif
	if (n == 4)
		*(pm_simd4_at *)record = four;
	else
		*(pm_simd2_at *)record = __builtin_shufflevector(four, four, 0, 1);
}

/* n numbers a record, n <= 4, turned in registers, so that a record is one store or two. The next ones are fetched between the stores: the memory then
 * reads while it writes. How many are moved. */
PM_SIMD_INLINE size_t move_turned(int n, const struct pm_tile_order *o, const struct moved *b, size_t *cursor)
{
	const size_t stride = (size_t)o->stride;
	size_t i = 0;
	if ((int)PM_SIMD_PART != (int)PM_SIMD_WIDTH)
		return 0;
	for (; i + PM_SIMD_WIDTH <= b->m; i += PM_SIMD_WIDTH) {
		pm_simd column[4], row[4];
		PM_SIMD_UNROLL
		for (int c = 0; c < 4; c++) {
			column[c] = pm_simd_load_any(b->value[c < n ? c : 0] + i);
			if (c < n)
				__builtin_prefetch(b->next[c] + i);
		}
		pm_simd_turn(column, row);
		PM_SIMD_UNROLL
		for (size_t l = 0; l < PM_SIMD_WIDTH; l++) {
			const size_t p = b->p + i + l;
			const uint32_t soon = o->tile[p + ahead < b->end ? p + ahead : p];
			double *record = o->records + stride * cursor[o->tile[p]]++;
			__builtin_prefetch(o->records + stride * cursor[soon] + n - 1, 1);
			put_record(n, row[l % 4], l / 4, record);
			if (n == 3) /* a further store takes less than to turn a third number */
				record[2] = b->value[2][i + l];
		}
	}
	return i;
}

/* cursor: the places of the chunk's first record in each tile; used up. */
static void move_chunk(struct pm_tile_order *o, int chunk, size_t *cursor)
{
	const int n = o->dim + o->nvalues;
	struct moved b = {.p = chunk_from(o, chunk), .end = chunk_to(o, chunk)};
	double u[3][batch], few[PM_COMPONENTS][batch];
	for (; b.p < b.end; b.p += b.m) {
		b.m = b.end - b.p < batch ? b.end - b.p : batch;
		locate(o, b.p, b.m, u);
		for (int c = 0; c < n; c++) {
			const struct pm_column *from = c < o->dim ? &o->x[c] : &o->values[c - o->dim];
			b.value[c] = c < o->dim ? u[c] : pm_column_take(from, b.p, b.m, few[c - o->dim]);
			b.next[c] = from->doubles ? from->doubles + b.p + PM_TILE_AHEAD : b.value[c];
		}
		size_t done = 0;
		if (n == 2)
			done = move_turned(2, o, &b, cursor);
		else if (n == 3)
			done = move_turned(3, o, &b, cursor);
		else if (n == 4)
			done = move_turned(4, o, &b, cursor);
		move_rest(o, &b, done, cursor);
	}
}

/* The columns that a record of floats has: positions, velocities of ways, values. */
static int columns_of(const struct pm_tile_order *o, const float *columns[PM_COMPONENTS + 6])
{
	int n = 0;
	for (int d = 0; d < o->dim; d++)
		columns[n++] = o->x[d].floats;
	for (int d = 0; d < o->dim && o->ways; d++)
		columns[n++] = o->v[d].floats;
	for (int c = 0; c < o->nvalues; c++)
		if (o->values[c].floats)
			columns[n++] = o->values[c].floats;
	return n;
}

static void move_floats(struct pm_tile_order *o, int chunk, size_t *cursor)
{
	const float *columns[PM_COMPONENTS + 6];
	const size_t packed = (size_t)o->packed, to = chunk_to(o, chunk);
	const int n = columns_of(o, columns);
	for (size_t p = chunk_from(o, chunk); p < to; p++) {
		float *record = o->floats + packed * cursor[o->tile[p]]++;
		__builtin_prefetch(o->floats + packed * cursor[o->tile[p + ahead < to ? p + ahead : p]] + packed - 1, 1);
		for (int k = 0; k < n; k++)
			record[k] = columns[k][p];
	}
}

const double *pm_tile_order_take(const struct pm_tile_order *o, size_t p, size_t m, const struct pm_column *from, double *few)
{
	const struct pm_tile_runs *r = &o->runs;
	if (!r->run || (!from->doubles && !from->floats))
		return pm_column_take(from, p, m, few);
	if (pm_tile_runs_together(r, p, m))
		return pm_column_take(from, pm_tile_runs_at(r, p), m, few);
	if (from->doubles) {
		pm_tile_runs_take(r, p, m, 1, &from->doubles, &few);
	} else {
		uint32_t place[batch];
		pm_tile_runs_places(r, p, m, place);
		for (size_t i = 0; i < m; i++)
			few[i] = pm_column_at(from, place[i]);
	}
	return few;
}

/* The same for column k of a record of floats, unless it is one number. */
static const double *take_packed(const struct pm_tile_order *o, size_t p, size_t m, const struct pm_column *from, int *k, double few[batch])
{
	if (!from->floats)
		return pm_tile_order_take(o, p, m, from, few);
	const float *record = o->floats + p * (size_t)o->packed + (*k)++;
	for (size_t i = 0; i < m; i++)
		few[i] = record[i * (size_t)o->packed];
	return few;
}

static const double *taken(const struct pm_tile_order *o, size_t p, size_t m, const struct pm_column *from, int *k, double few[batch])
{
	return o->floats ? take_packed(o, p, m, from, k, few) : pm_tile_order_take(o, p, m, from, few);
}

void pm_tile_order_pack(const struct pm_tile_order *o, size_t p, size_t m, bool values, double *records)
{
	double u[batch], length[batch], few[2][batch];
	const size_t stride = (size_t)o->stride, first = (size_t)(o->ways ? 2 * o->dim : o->dim);
	int x = 0, v = o->dim, k = (int)first; /* of a record of floats */
	for (int d = 0; d < o->dim; d++) {
		const double *at = taken(o, p, m, &o->x[d], &x, few[0]);
		pm_axis_locate_many(&o->axes[d], m, at, u);
		if (o->ways)
			pm_tile_ways(o->dt, o->axes[d].h, m, at, taken(o, p, m, &o->v[d], &v, few[1]), length);
		for (size_t i = 0; i < m; i++)
			records[i * stride + (size_t)d] = u[i];
		for (size_t i = 0; i < m && o->ways; i++)
			records[i * stride + (size_t)(o->dim + d)] = length[i];
	}
	for (int c = 0; c < (values ? o->nvalues : 0); c++) {
		const double *value = taken(o, p, m, &o->values[c], &k, few[0]);
		for (size_t i = 0; i < m; i++)
			records[i * stride + first + (size_t)c] = value[i];
	}
}

void pm_tile_order_columns(const struct pm_tile_order *o, size_t p, size_t m, bool values, double *const to[])
{
	double few[2][batch];
	const int dim = o->dim, first = o->ways && values ? 2 * dim : dim, all = first + (values ? o->nvalues : 0);
	int x = 0, v = dim, k = o->ways ? 2 * dim : dim; /* of a record of floats */
	if (o->records) {
		const double *record = o->records + p * (size_t)o->stride;
		for (size_t i = 0; i < m; i++, record += o->stride)
			for (int c = 0; c < all; c++)
				to[c][i] = record[c];
		return;
	}
	for (int d = 0; d < dim; d++) {
		const double *at = taken(o, p, m, &o->x[d], &x, few[0]);
		pm_axis_locate_many(&o->axes[d], m, at, to[d]);
		if (o->ways && values)
			pm_tile_ways(o->dt, o->axes[d].h, m, at, taken(o, p, m, &o->v[d], &v, few[1]), to[dim + d]);
	}
	for (int c = first; c < all; c++) {
		const double *value = taken(o, p, m, &o->values[c - first], &k, few[0]);
		memcpy(to[c], value, m * sizeof *value);
	}
}

void pm_tile_order_values(const struct pm_tile_order *o, size_t p, size_t m, double *const to[])
{
	double few[batch];
	for (int c = 0; c < o->nvalues; c++) {
		const double *value = pm_tile_order_take(o, p, m, &o->values[c], few);
		memcpy(to[c], value, m * sizeof *value);
	}
}

static int allocate(struct pm_tile_order *o)
{
	size_t columns = o->tiles + 1;
	o->begin = pm_alloc(columns + 1, sizeof *o->begin);
	o->cursor = pm_alloc((size_t)(o->chunks + 1) * columns, sizeof *o->cursor);
	return o->begin && o->cursor ? 0 : -PM_DATA;
}

/* True if the stream is in the order of tiles and has no strays; the cursors then hold its counts. */
static bool in_order(struct pm_tile_order *o)
{
	uint32_t(*ends)[2] = pm_alloc((size_t)o->chunks, sizeof *ends);
	int falls = !ends; /* no memory: said again where more is asked for */
#pragma omp parallel for num_threads(o->chunks) schedule(static, 1) reduction(| : falls) if (ends)
	for (int chunk = 0; chunk < (ends ? o->chunks : 0); chunk++)
		falls |= !count_in_order(o, chunk, ends[chunk]);
	for (int chunk = 1; chunk < o->chunks && !falls; chunk++)
		falls |= ends[chunk][0] < ends[chunk - 1][1];
	pm_free(ends);
	return !falls;
}

/* Are x, v of ways and all values floats or one number? Then so are the records. */
static bool packs(const struct pm_tile_order *o)
{
	bool all = true;
	for (int d = 0; d < o->dim; d++)
		all = all && o->x[d].floats && (!o->ways || o->v[d].floats);
	for (int c = 0; c < o->nvalues; c++)
		all = all && !o->values[c].doubles;
	return all;
}

static int allocate_records(struct pm_tile_order *o)
{
	const float *columns[PM_COMPONENTS + 6];
	if (packs(o)) {
		o->packed = columns_of(o, columns);
		o->floats = pm_alloc(o->n * (size_t)o->packed + 1, sizeof *o->floats);
		return o->floats ? 0 : -PM_DATA;
	}
	size_t doubles = o->n * (size_t)o->stride;
	o->records = pm_alloc(doubles + 4, sizeof *o->records); /* 4: records are read as vectors */
	if (!o->records)
		return -PM_DATA;
	memset(o->records + doubles, 0, 4 * sizeof *o->records);
	return 0;
}

static void move_records(struct pm_tile_order *o, int chunk, size_t *cursor)
{
	if (o->floats)
		move_floats(o, chunk, cursor);
	else
		move_chunk(o, chunk, cursor);
}

/* Of all chunks: the first stray is that of the first chunk that has one. */
static void add_strays(int chunks, const struct pm_strays *each, struct pm_strays *strays)
{
	for (int chunk = chunks - 1; chunk >= 0; chunk--) {
		uint64_t count = strays->count;
		if (each[chunk].count)
			*strays = each[chunk];
		strays->count = count + each[chunk].count;
	}
}

/* 1: the runs of a stream that is nearly in order, 0: it is not, or failure. */
static int find_runs(struct pm_tile_order *o, size_t stays, struct pm_strays *each, struct pm_strays *strays)
{
	const size_t columns = o->tiles + 1, most = o->n / (size_t)o->chunks + (size_t)o->chunks; /* in a chunk */
	const size_t room = begun + batch + (most / PM_TILE_RUN + 1) * stays; /* a run has an eight or more */
	struct pm_tile_finds *f = pm_alloc((size_t)o->chunks, sizeof *f);
	struct pm_tile_found *found = pm_alloc((size_t)o->chunks * room, sizeof *found);
	int moved = 0, status = f && found ? 0 : -PM_DATA;
#pragma omp parallel for num_threads(o->chunks) schedule(static, 1) reduction(| : moved) if (!status)
	for (int chunk = 0; chunk < (status ? 0 : o->chunks); chunk++) {
		f[chunk] = (struct pm_tile_finds){.found = found + (size_t)chunk * room, .room = room};
		moved |= !find_chunk(o, chunk, stays, &f[chunk], &each[chunk]);
	}
	if (!status && !moved) {
		add_up(o);
		status = pm_tile_runs_init(&o->runs, f, o->n, o->tiles, o->chunks, o->cursor + columns);
		add_strays(o->chunks, each, strays);
	}
	pm_free(found), pm_free(f);
	return status ? status : !moved;
}

/* The tiles of a stream in any order, and its records in theirs. */
static int move(struct pm_tile_order *o, bool records, struct pm_strays *each, struct pm_strays *strays)
{
	const size_t columns = o->tiles + 1;
	o->tile = pm_alloc(o->n, sizeof *o->tile);
	if (!o->tile)
		return -PM_DATA;
#pragma omp parallel for num_threads(o->chunks) schedule(static, 1)
	for (int chunk = 0; chunk < o->chunks; chunk++)
		count_chunk(o, chunk, &each[chunk]);
	add_up(o);
	add_strays(o->chunks, each, strays);
	if (records && allocate_records(o))
		return -PM_DATA;
#pragma omp parallel for num_threads(o->chunks) schedule(static, 1)
	for (int chunk = 0; chunk < (records ? o->chunks : 0); chunk++)
		move_records(o, chunk, o->cursor + (size_t)(chunk + 1) * columns);
	return 0;
}

static int runs_or_move(struct pm_tile_order *o, int stays, struct pm_strays *strays)
{
	struct pm_strays *each = pm_alloc((size_t)o->chunks, sizeof *each);
	int status = !each ? -PM_DATA : stays && o->n <= UINT32_MAX ? find_runs(o, (size_t)stays, each, strays) : 0;
	if (!status)
		status = move(o, !stays || !o->ways || packs(o), each, strays);
	pm_free(each);
	return status < 0 ? status : 0;
}

void pm_tile_order_spend(struct pm_tile_order *o)
{
	o->records = pm_free(o->records);
	o->floats = pm_free(o->floats);
	o->nvalues = 0;
}

int pm_tile_order_again(struct pm_tile_order *o, int room)
{
	const size_t rows = (size_t)o->chunks * (o->tiles + 1);
	size_t *cursors = pm_alloc(rows, sizeof *cursors);
	o->stride = o->dim > room ? o->dim : room;
	if (!cursors || allocate_records(o))
		return pm_free(cursors), -PM_DATA;
	memcpy(cursors, o->cursor, rows * sizeof *cursors);
#pragma omp parallel for num_threads(o->chunks) schedule(static, 1)
	for (int chunk = 0; chunk < o->chunks; chunk++)
		move_records(o, chunk, cursors + (size_t)chunk * (o->tiles + 1));
	pm_free(cursors);
	return 0;
}

/* The tile of particle p; `tiles` of a stray. */
static size_t tile_at(const struct pm_tile_order *o, size_t p)
{
	size_t tile = 0;
	for (int d = o->dim - 1; d >= 0; d--) {
		double u;
		if (!pm_axis_locate(&o->axes[d], o->x[d].doubles[p], &u) || !(u >= 0))
			return o->tiles;
		tile = tile * o->across[d] + ((size_t)u >> pm_tile_shift[o->dim][d]);
	}
	return tile;
}

/* Of some pairs of neighbours in the stream. */
static bool seems_in_order(const struct pm_tile_order *o)
{
	enum { pairs = 512 };
	size_t last = 0;
	for (size_t k = 0; k < pairs; k++) {
		const size_t p = (size_t)((double)(o->n - 2) * (double)k / (pairs - 1)), here = tile_at(o, p), next = tile_at(o, p + 1);
		if (here < last || next < here || next == o->tiles)
			return false;
		last = next;
	}
	return true;
}

/* The first particle from `from` on that is in this tile or a later one, if the stream is in order: about `guess` further on. */
static size_t first_of(const struct pm_tile_order *o, size_t tile, size_t from, size_t guess)
{
	size_t low = from, high = o->n, at = from + guess < o->n ? from + guess : o->n, step = 4;
	while (low < high && at > low && tile_at(o, at - 1) >= tile)
		high = at - 1, at = at - low > step ? at - step : low, step *= 2;
	low = at > low ? at : low;
	for (step = 4; low < high && low + step < high && tile_at(o, low + step) < tile; step *= 2)
		low += step + 1;
	high = low + step < high ? low + step : high;
	while (low < high) {
		const size_t middle = low + (high - low) / 2;
		if (tile_at(o, middle) < tile)
			low = middle + 1;
		else
			high = middle;
	}
	return low;
}

/* Whether nearly all particles are in tiles that have many: those of others are looked at for themselves (transfer.c), as a count does. */
static bool are_dense(const struct pm_tile_order *o)
{
	size_t few = 0;
	for (size_t t = 0; t < o->tiles; t++) {
		const size_t count = o->begin[t + 1] - o->begin[t];
		few += count < PM_TILE_CELLS / 4 ? count : 0;
	}
	return few < o->n / 8;
}

/* True if the stream seems to be in order; then begin[] is that of such a stream. */
static bool assume_order(struct pm_tile_order *o)
{
	enum { least = 8192, each = 256 }; /* particles; of a tile, in the mean: for fewer a search takes as long as a count */
	for (int d = 0; d < o->dim; d++)
		if (!o->x[d].doubles)
			return false;
	if (o->ways || o->n < least || o->n < each * o->tiles || !seems_in_order(o))
		return false;
	size_t guess = o->n / o->tiles;
	o->begin[0] = 0;
	for (size_t t = 1; t < o->tiles; t++) {
		o->begin[t] = first_of(o, t, o->begin[t - 1], guess);
		guess = o->begin[t] - o->begin[t - 1];
	}
	o->begin[o->tiles] = o->begin[o->tiles + 1] = o->n;
	return o->assumed = are_dense(o);
}

bool pm_tile_order_all_in(const struct pm_tile_order *o, size_t tile, size_t p, size_t m)
{
	struct pm_axis_lanes lanes[3];
	uint32_t at[batch], others = 0;
	for (int d = 0; d < o->dim; d++)
		lanes[d] = pm_axis_lanes(&o->axes[d]);
	if (!batch_tiles(o, lanes, p, m, at))
		return false;
	for (size_t i = 0; i < m; i++)
		others |= at[i] ^ (uint32_t)tile;
	return !others;
}

static int count_tiles(struct pm_tile_order *o, const struct pm_axis axes[3])
{
	o->tiles = 1;
	for (int d = 0; d < 3; d++) {
		int shift = pm_tile_shift[o->dim][d];
		o->across[d] = (uint32_t)((axes[d].count - 1) >> shift) + 1;
		o->tiles *= o->across[d];
		if (axes[d].count > INT32_MAX || o->tiles >= UINT32_MAX)
			return pm_fail(PM_DATA, "a mesh of %zu cells along %c is too large for p2m and m2p", axes[d].count, "xyz"[d]);
	}
	return 0;
}

int pm_tile_order_init(struct pm_tile_order *o, const struct pm_axis axes[3], const struct pm_tile_particles *p, int room, struct pm_strays *strays)
{
	int dim = p->dim, nvalues = p->nvalues, need = (p->v ? 2 * dim : dim) + nvalues;
	size_t n = p->n;
	*o = (struct pm_tile_order){.dim = dim, .n = n, .chunks = pm_threads(), .stride = need > room ? need : room, .axes = axes, .nvalues = nvalues,
		.ways = p->v, .dt = p->dt, .finite = p->finite};
	*strays = (struct pm_strays){.count = 0};
	for (int d = 0; d < dim; d++) {
		o->x[d] = p->x[d];
		o->columns |= !p->x[d].doubles;
		if (p->v)
			o->v[d] = p->v[d], o->columns |= !p->v[d].doubles;
	}
	for (int c = 0; c < nvalues; c++)
		o->values[c] = p->values[c], o->columns |= p->values[c].floats != NULL;
	int status = count_tiles(o, axes);
	if (status)
		return status;
	while (o->chunks > 1 && ((size_t)o->chunks * (pm_many_turns() / 4) > n || (size_t)o->chunks * o->tiles > 4 * n)) /* not worth the rows of the cursors */
		o->chunks--;
	if ((status = allocate(o)))
		return status;
	if (p->assume && assume_order(o))
		return 0;
	if (!in_order(o))
		return runs_or_move(o, p->v && !p->stays ? PM_STAY_WIDE : p->stays, strays);
	add_up(o);
	return 0;
}

void pm_tile_order_free(struct pm_tile_order *o)
{
	pm_free(o->tile);
	pm_free(o->begin);
	pm_free(o->cursor);
	pm_free(o->records);
	pm_free(o->floats);
	pm_tile_runs_free(&o->runs);
	*o = (struct pm_tile_order){.n = 0};
}
