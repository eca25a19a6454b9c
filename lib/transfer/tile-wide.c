/* Gather and spread by kernels of three to eight points. As many particles as a register has lanes find their cells, the weights of their points, and the
 * products of these for the rows around them (y, z) together, a particle a lane. A value is then the sum of its rows, times these products, and the sums of
 * all particles are made at once, because one waits for the row before it; what is left, a number for every point along x, is turned into lanes again and
 * multiplied by the weights along x. Of a vector in 3-D all components of a node are one load (tile-vector.h). Every sum has the order of the loops for all
 * kernels (transfer-tile.c): the same bytes. Cost: width^dim products per particle and component. SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/tile-eight.h"
#include "transfer/tile-lanes.h"
#include "transfer/tile-neighbours.h"
#include "transfer/tile-vector.h"
#include "transfer/tile-wide.h"

enum { node_row = PM_NODE_ROW, node_plane = PM_NODE_PLANE };

/* w[d][k] of point k on axis d: those of find_weights (tile-lanes.h) to the last bit. Sums wait for the power before, so those of all points go on together. */
PM_SIMD_INLINE void weights_of(int dim, const struct pm_kernel *kernel, int width, int degree, const pm_simd t[3], pm_simd w[3][most])
{
	const bool may_fold = pm_kernel_folds(width, degree, 1);
	const double *coefficient = kernel->coefficients + degree * width;
	pm_simd_bits fold[3];
	pm_simd s[3], v[3][most];
	PM_SIMD_UNROLL
	for (int d = 0; d < dim; d++) {
		fold[d] = t[d] > 0.5;
		s[d] = may_fold ? (pm_simd)((fold[d] & (pm_simd_bits)(1 - t[d])) | (~fold[d] & (pm_simd_bits)t[d])) : t[d];
		PM_SIMD_UNROLL
		for (int k = 0; k < width; k++)
			v[d][k] = pm_simd_all(coefficient[k]);
	}
	for (int power = degree - 1; power >= 0; power--) {
		coefficient -= width;
		PM_SIMD_UNROLL
		for (int k = 0; k < width; k++)
			PM_SIMD_UNROLL
			for (int d = 0; d < dim; d++)
				v[d][k] = v[d][k] * s[d] + coefficient[k];
	}
	PM_SIMD_UNROLL
	for (int d = 0; d < dim; d++)
		PM_SIMD_UNROLL
		for (int k = 0; k < width; k++)
			w[d][k] = may_fold ? (pm_simd)((fold[d] & (pm_simd_bits)v[d][width - 1 - k]) | (~fold[d] & (pm_simd_bits)v[d][k])) : v[d][k];
}

/* The weights of particles side by side: x[point], f[z][y]; strength: of spread, where the product of rows has it, or NULL. */
PM_SIMD_INLINE void find_factors(int dim, int width, int degree, const struct pm_tile *t, const pm_simd *distance, const pm_simd *strength, pm_simd *x,
	pm_simd_at *f)
{
	pm_simd from[3], w[3][most];
	PM_SIMD_UNROLL
	for (int d = 0; d < dim; d++)
		from[d] = distance[d] - t->shift;
	weights_of(dim, t->kernel, width, degree, from, w);
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++)
		x[k] = w[0][k];
	for (int z = 0; z < planes_of(dim, width); z++) {
		pm_simd first = dim > 2 ? w[2][z] : pm_simd_all(1);
		first = strength ? *strength * first : first;
		PM_SIMD_UNROLL
		for (int y = 0; y < most; y++)
			if (y < rows_of(dim, width))
				f[z * width + y] = dim > 1 ? first * w[1][y] : first;
	}
}

/* Their first points. */
PM_SIMD_INLINE pm_simd_int first_of(int dim, const struct eight *e)
{
	const int row = pm_block_row[dim], plane = row * pm_block_rows[dim];
	pm_simd_int first = e->cell[0];
	if (dim > 1)
		first += e->cell[1] * row;
	if (dim > 2)
		first += e->cell[2] * plane;
	return first;
}

/* Where the factors of rows are found: those of space, which are many, in memory. */
PM_SIMD_INLINE pm_simd_at *rows_for(int dim, pm_simd_at *here, struct lot *lot) { return dim < 3 ? here : (pm_simd_at *)lot->f; }

/* Leaves a lot in memory. */
PM_SIMD_INLINE void put_lot(int dim, int width, pm_simd_int at, const pm_simd *x, const pm_simd_at *f, struct lot *lot)
{
	*(pm_simd_int_at *)lot->at = at;
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++)
		pm_simd_store(lot->x + k * PM_SIMD_WIDTH, x[k]);
	PM_SIMD_UNROLL
	for (int y = 0; y < most; y++)
		if (dim < 3 && y < rows_of(dim, width))
			pm_simd_store(lot->f + y * PM_SIMD_WIDTH, f[y]);
}

/* Those from a lane on, as the first ones; only m of them count. */
PM_SIMD_INLINE void factors_from(int dim, int width, const struct lot *lot, size_t from, size_t m, pm_simd *x, pm_simd_at *f)
{
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++)
		x[k] = pm_simd_load_any(lot->x + (size_t)k * PM_SIMD_WIDTH + from);
	for (int z = 0; z < planes_of(dim, width); z++)
		PM_SIMD_UNROLL
		for (int y = 0; y < most; y++)
			if (y < rows_of(dim, width))
				f[z * width + y] = pm_simd_between(0, m, pm_simd_load_any(lot->f + (size_t)(z * width + y) * PM_SIMD_WIDTH + from),
					pm_simd_all(0));
}

/* The weights along x of every particle side by side. */
PM_SIMD_INLINE void rows_of_lot(int width, const struct lot *lot, double row[PM_SIMD_WIDTH][most])
{
	PM_SIMD_UNROLL
	for (int from = 0; from < padded(width); from += 4) {
		pm_simd v[4], u[4];
		PM_SIMD_UNROLL
		for (int k = 0; k < 4; k++)
			v[k] = from + k < width ? pm_simd_load(lot->x + (from + k) * PM_SIMD_WIDTH) : pm_simd_all(0);
		pm_simd_turn(v, u);
		PM_SIMD_UNROLL
		for (int l = 0; l < PM_SIMD_WIDTH; l++) {
			const pm_simd4_at *four = (const pm_simd4_at *)&u[l % 4] + l / 4;
			*(pm_simd4_at *)(row[l] + from) = *four;
		}
	}
}

/* A row of points as fours and a pair: a load of eight numbers, and a number brought to eight lanes, take twice as long as those of four, and more of eight
 * cross a line of the cache. */
struct points {
	pm_simd4_at four[2];
	pm_simd2_at two;
};

PM_SIMD_INLINE int points_many(int width) { return width <= 4 ? 4 : width <= 6 ? 6 : 8; }

/* The factor of a row; held: there are registers for those of many. */
PM_SIMD_INLINE pm_simd4_at factor_of(bool held, double f) { return held ? (pm_simd4_at){f, f, f, f} : pm_simd4_here(f); }

PM_SIMD_INLINE void points_more(int n, pm_simd4_at a, const double *x, struct points *p)
{
	p->four[0] += *(const pm_simd4_at *)x * a;
	if (n == 6)
		p->two += *(const pm_simd2_at *)(x + 4) * __builtin_shufflevector(a, a, 0, 1);
	if (n == 8)
		p->four[1] += *(const pm_simd4_at *)(x + 4) * a;
}

/* Those from 0 or 4 on. */
PM_SIMD_INLINE pm_simd4_at points_from(int n, int from, const struct points *p)
{
	return from && n == 6 ? (pm_simd4_at)__builtin_shufflevector(p->two, p->two, 0, 1, 0, 1) : p->four[from / 4];
}

PM_SIMD_INLINE struct points points_of(int n, const double *x)
{
	struct points p = {.two = {0}};
	p.four[0] = *(const pm_simd4_at *)x;
	if (n == 6)
		p.two = *(const pm_simd2_at *)(x + 4);
	if (n == 8)
		p.four[1] = *(const pm_simd4_at *)(x + 4);
	return p;
}

PM_SIMD_INLINE void points_add(int n, pm_simd4_at a, const struct points *x, double *y)
{
	*(pm_simd4_at *)y += x->four[0] * a;
	if (n == 6)
		*(pm_simd2_at *)(y + 4) += x->two * __builtin_shufflevector(a, a, 0, 1);
	if (n == 8)
		*(pm_simd4_at *)(y + 4) += x->four[1] * a;
}

/* The first m particles of a lot one by one. */
PM_SIMD_INLINE void spread_apart(int dim, int width, const struct lot *lot, size_t m, double *block)
{
	const int n = points_many(width), across = pm_block_row[dim], plane = across * pm_block_rows[dim];
	double row[PM_SIMD_WIDTH][most] __attribute__((aligned(64)));
	rows_of_lot(width, lot, row);
	for (size_t l = 0; l < m; l++) {
		const struct points x = points_of(n, row[l]);
		double *to = block + (size_t)(uint32_t)lot->at[l];
		for (int z = 0; z < planes_of(dim, width); z++)
			for (int y = 0; y < rows_of(dim, width); y++) {
				const double f = lot->f[(size_t)(z * width + y) * PM_SIMD_WIDTH + l];
				points_add(n, factor_of(width <= 4, f), &x, to + z * plane + y * across);
			}
	}
}

/* The first m of a lot; not inlined: it is the same whatever the degree. */
PM_SIMD_INLINE void spread_some(int dim, int width, const struct lot *lot, size_t m, double *block)
{
	const struct runs r = runs_of(dim, lot, m);
	if (r.n > FEW_RUNS) {
		spread_apart(dim, width, lot, m, block);
		return;
	}
	for (int i = 0; i < r.n; i++) {
		pm_simd x[most];
		pm_simd_at f[most * most];
		factors_from(dim, width, lot, r.at[i], r.at[i + 1] - r.at[i], x, f);
		spread_neighbours(dim, width, x, f, block + lot->at[r.at[i]]);
	}
}
typedef void some_spread(const struct lot *lot, size_t m, double *block);

/* Eight records, or particles straight from the stream where there is a batch; *strength: of a spread, of which q are those of the batch. */
PM_SIMD_INLINE struct eight find(int dim, const struct pm_tile *t, const struct pm_tile_batch *b, size_t i, size_t m, const double *q, pm_simd *strength)
{
	const double *record[PM_SIMD_WIDTH];
	pm_simd unused;
	if (b && strength) {
		if (m == PM_SIMD_WIDTH)
			*strength = pm_simd_load_any(q + i);
		else
			memcpy(strength, q + i, m * sizeof *q);
		__builtin_prefetch(b->next_value + i, 0, 2);
	}
	if (b)
		return find_eight_of(dim, t, b, i);
	PM_SIMD_UNROLL
	for (size_t l = 0; l < PM_SIMD_WIDTH; l++) {
		record[l] = t->records + (i + (l < m ? l : 0)) * (size_t)t->stride;
		if (strength)
			(*strength)[l] = record[l][t->value];
	}
	return find_eight_at(t, record, &unused);
}

PM_SIMD_INLINE void spread(int dim, int width, int degree, some_spread *some, const struct pm_tile *t, const struct pm_tile_batch *b, const double *q)
{
	struct lot lot = {.x = {0}};
	const size_t count = b ? b->m : t->count;
	for (size_t i = 0; i < count; i += PM_SIMD_WIDTH) {
		const size_t m = count - i < PM_SIMD_WIDTH ? count - i : PM_SIMD_WIDTH;
		pm_simd x[most], strength = {0};
		pm_simd_at here[most], *f = rows_for(dim, here, &lot);
		const struct eight e = find(dim, t, b, i, m, q, &strength);
		const pm_simd_int at = first_of(dim, &e);
		find_factors(dim, width, degree, t, e.distance, &strength, x, f);
		if (m == PM_SIMD_WIDTH && are_neighbours(at)) {
			spread_neighbours(dim, width, x, f, t->block + at[0]);
			continue;
		}
		put_lot(dim, width, at, x, f, &lot);
		some(&lot, m, t->block);
	}
}

/* A component at all particles of a lot. */
PM_SIMD_INLINE pm_simd value_of(int dim, int width, const struct lot *lot, const double *block)
{
	const int n = dim < 3 && (int)PM_SIMD_PART == 4 ? padded(width) : points_many(width);
	const int row = pm_block_row[dim], plane = row * pm_block_rows[dim], rows = dim > 1 ? width : 1;
	const bool held = dim < 3 || width == 4; /* there are registers for the factors */
	struct points sum[PM_SIMD_WIDTH];
	pm_simd value = {0};
	PM_SIMD_UNROLL
	for (int l = 0; l < PM_SIMD_WIDTH; l++)
		sum[l] = (struct points){.two = {0}};
	for (int z = 0; z < planes_of(dim, width); z++)
		for (int y = 0; y < rows; y++) {
			PM_SIMD_UNROLL
			for (int l = 0; l < PM_SIMD_WIDTH; l++) {
				const double f = lot->f[(z * width + y) * PM_SIMD_WIDTH + l];
				points_more(n, factor_of(held, f), block + (size_t)(uint32_t)lot->at[l] + z * plane + y * row, &sum[l]);
			}
		}
	PM_SIMD_UNROLL
	for (int from = 0; from < width; from += 4) {
		pm_simd4_at four[PM_SIMD_WIDTH];
		pm_simd point[4];
		PM_SIMD_UNROLL
		for (int l = 0; l < PM_SIMD_WIDTH; l++)
			four[l] = points_from(n, from, &sum[l]);
		pm_simd_rows_to_lanes(four, point);
		PM_SIMD_UNROLL
		for (int k = 0; k < 4; k++)
			if (from + k < width)
				value += point[k] * pm_simd_load(lot->x + (from + k) * PM_SIMD_WIDTH);
	}
	return value;
}

/* Components at the first m, by runs of neighbours where there are few; not inlined. */
PM_SIMD_INLINE void gather_some(int dim, int width, const struct lot *lot, size_t m, int components, const double *block, double value[][2 * PM_SIMD_WIDTH])
{
	const struct runs r = runs_of(dim, lot, m);
	for (int c = 0; c < components; c++, block += PM_BLOCK_MOST) {
		if (r.n > FEW_RUNS)
			pm_simd_store_any(value[c], value_of(dim, width, lot, block));
		for (int i = 0; i < r.n && r.n <= FEW_RUNS; i++) {
			pm_simd x[most];
			pm_simd_at f[most * most];
			factors_from(dim, width, lot, r.at[i], PM_SIMD_WIDTH, x, f);
			pm_simd_store_any(value[c] + r.at[i], gather_neighbours(dim, width, x, f, block + lot->at[r.at[i]]));
		}
	}
}
typedef void some_gather(const struct lot *lot, size_t m, int components, const double *block, double value[][2 * PM_SIMD_WIDTH]);

/* All components of a node: at particle l. */
PM_SIMD_INLINE pm_simd4_at node_value(int width, const struct lot *lot, size_t l, const double *nodes)
{
	const double *from = nodes + (size_t)(uint32_t)lot->at[l];
	pm_simd4_at sum[most], value = {0};
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++)
		sum[k] = (pm_simd4_at){0};
	for (int z = 0; z < width; z++) {
		PM_SIMD_UNROLL
		for (int y = 0; y < width; y++) {
			const pm_simd4_at *row = (const pm_simd4_at *)(from + z * node_plane + y * node_row);
			const double f = lot->f[(size_t)(z * width + y) * PM_SIMD_WIDTH + l];
			PM_SIMD_UNROLL
			for (int k = 0; k < width; k++)
				sum[k] += row[k] * f;
		}
	}
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++)
		value += sum[k] * lot->x[(size_t)k * PM_SIMD_WIDTH + l];
	return value;
}

/* Two nodes a load, where a register holds eight numbers. */
PM_SIMD_INLINE pm_simd4_at pair_value(int width, const struct lot *lot, size_t l, const double *nodes)
{
	const int pairs = width / 2;
	const double *from = nodes + (size_t)(uint32_t)lot->at[l];
	pm_simd8_at sum[most / 2] = {{0}};
	pm_simd4_at last = {0}, value = {0};
	for (int z = 0; z < width; z++) {
		PM_SIMD_UNROLL
		for (int y = 0; y < width; y++) {
			const double *row = from + z * node_plane + y * node_row, f = lot->f[(size_t)(z * width + y) * PM_SIMD_WIDTH + l];
			PM_SIMD_UNROLL
			for (int k = 0; k < pairs; k++)
				sum[k] += *(const pm_simd8_at *)(row + 8 * k) * f;
			if (width % 2)
				last += *(const pm_simd4_at *)(row + 8 * pairs) * f;
		}
	}
	PM_SIMD_UNROLL
	for (int k = 0; k < pairs; k++) {
		value += __builtin_shufflevector(sum[k], sum[k], 0, 1, 2, 3) * lot->x[(size_t)(2 * k) * PM_SIMD_WIDTH + l];
		value += __builtin_shufflevector(sum[k], sum[k], 4, 5, 6, 7) * lot->x[(size_t)(2 * k + 1) * PM_SIMD_WIDTH + l];
	}
	if (width % 2)
		value += last * lot->x[(size_t)(width - 1) * PM_SIMD_WIDTH + l];
	return value;
}

/* n components of a group to a result, whose later numbers are written later. */
PM_SIMD_INLINE void put(double *result, int n, int room, pm_simd4_at value)
{
	if (room >= 4) {
		*(pm_simd4_at *)result = value;
		return;
	}
	for (int c = 0; c < n; c++)
		result[c] = value[c];
}

/* Values of n particles: straight to the stream, or to the results. */
PM_SIMD_INLINE void leave(const struct pm_tile *t, const struct pm_tile_batch *b, const struct delivery *to, size_t i, size_t n, int c, pm_simd value,
	pm_simd *nothing)
{
	if (b)
		deliver_eight(value, n, &to[c], b->p + i, nothing);
	for (size_t l = 0; l < n && !b; l++)
		t->results[(i + l) * (size_t)t->to + (size_t)c] = value[l];
}

/* From records, or a batch and with r. True if what is left is finite. */
PM_SIMD_INLINE bool gather(int dim, int width, int degree, some_gather *some, const struct pm_tile *t, const struct pm_tile_batch *b,
	const struct pm_tile_results *r)
{
	struct delivery to[PM_COMPONENTS];
	struct lot lot = {.x = {0}};
	pm_simd nothing = {0};
	double value[PM_COMPONENTS][2 * PM_SIMD_WIDTH];
	const size_t count = b ? b->m : t->count;
	for (int c = 0; c < t->components && b; c++)
		to[c] = delivery_of(r, c);
	for (size_t i = 0; i < count; i += PM_SIMD_WIDTH) {
		const size_t n = count - i < PM_SIMD_WIDTH ? count - i : PM_SIMD_WIDTH;
		const struct eight e = find(dim, t, b, i, n, NULL, NULL);
		const pm_simd_int at = first_of(dim, &e);
		pm_simd x[most];
		pm_simd_at here[most], *f = rows_for(dim, here, &lot);
		find_factors(dim, width, degree, t, e.distance, NULL, x, f);
		if (n == PM_SIMD_WIDTH && are_neighbours(at)) {
			for (int c = 0; c < t->components; c++)
				leave(t, b, to, i, n, c, gather_neighbours(dim, width, x, f, t->block + (size_t)c * PM_BLOCK_MOST + at[0]), &nothing);
			continue;
		}
		put_lot(dim, width, at, x, f, &lot);
		some(&lot, n, t->components, t->block, value);
		for (int c = 0; c < t->components; c++)
			leave(t, b, to, i, n, c, pm_simd_load_any(value[c]), &nothing);
	}
	return !pm_simd_outside(nothing, (pm_simd){0}, (pm_simd){0});
}

/* All components of a node of a woven block at once. */
PM_SIMD_INLINE void woven(int width, int degree, const struct pm_tile *t)
{
	uint16_t order[PM_TILE_CELLS];
	struct lot lot;
	for (size_t from = 0; from < t->count; from += PM_TILE_CELLS) {
		const size_t m = t->count - from < PM_TILE_CELLS ? t->count - from : PM_TILE_CELLS;
		const bool sorted = width > 3 && m >= 128; /* of few points, sorting costs more than it saves */
		if (sorted)
			pm_tile_order_cells(t, from, m, order);
		for (size_t i = 0; i < m; i += PM_SIMD_WIDTH) {
			const size_t n = m - i < PM_SIMD_WIDTH ? m - i : PM_SIMD_WIDTH;
			const double *record[PM_SIMD_WIDTH];
			size_t index[PM_SIMD_WIDTH];
			pm_simd x[most], unused;
			for (size_t l = 0; l < PM_SIMD_WIDTH; l++) { /* the last ones may be fewer: the first of them stands in for the rest */
				index[l] = from + (sorted ? order[i + (l < n ? l : 0)] : i + (l < n ? l : 0));
				record[l] = t->records + index[l] * (size_t)t->stride;
			}
			const struct eight e = find_eight_at(t, record, &unused);
			find_factors(3, width, degree, t, e.distance, NULL, x, (pm_simd_at *)lot.f);
			put_lot(3, width, first_of(3, &e) * 4, x, NULL, &lot);
			const int group = pm_vector_group(t->components);
			const double *nodes = t->nodes;
			for (int c = 0; c < t->components; c += group, nodes += PM_VECTOR_NODES)
				for (size_t l = 0; l < n; l++)
					put(t->results + index[l] * (size_t)t->to + c, t->components - c < group ? t->components - c : group, t->to - c,
						(int)PM_SIMD_PART == 8 && width > 3 ? pair_value(width, &lot, l, nodes) : node_value(width, &lot, l, nodes));
		}
	}
}

#define SOME(dim, width) \
	static __attribute__((noinline)) void spread_some_##dim##_##width(const struct lot *lot, size_t m, double *block) \
	{ \
		spread_some(dim, width, lot, m, block); \
	} \
	static __attribute__((noinline)) void gather_some_##dim##_##width(const struct lot *lot, size_t m, int components, const double *block, \
		double value[][2 * PM_SIMD_WIDTH]) \
	{ \
		gather_some(dim, width, lot, m, components, block, value); \
	}
#define LOOPS(dim, width, name, degree) \
	static void spread_batch_##name##_##dim##_##width(const struct pm_tile *t, const struct pm_tile_batch *b, const double *q) \
	{ \
		spread(dim, width, degree, spread_some_##dim##_##width, t, b, q); \
	} \
	static bool gather_batch_##name##_##dim##_##width(const struct pm_tile *t, const struct pm_tile_batch *b, const struct pm_tile_results *r) \
	{ \
		return gather(dim, width, degree, gather_some_##dim##_##width, t, b, r); \
	} \
	static void spread_##name##_##dim##_##width(const struct pm_tile *t) { spread_batch_##name##_##dim##_##width(t, NULL, NULL); } \
	static void gather_##name##_##dim##_##width(const struct pm_tile *t) { gather_batch_##name##_##dim##_##width(t, NULL, NULL); }
#define WOVEN(width, name, degree) static void woven_##name##_##width(const struct pm_tile *t) { woven(width, degree, t); }
#define DIMS(width) \
	SOME(1, width) SOME(2, width) SOME(3, width) \
	LOOPS(1, width, spline, width - 1) LOOPS(2, width, spline, width - 1) LOOPS(3, width, spline, width - 1) WOVEN(width, spline, width - 1) \
	LOOPS(1, width, any, t->kernel->degree) LOOPS(2, width, any, t->kernel->degree) LOOPS(3, width, any, t->kernel->degree) \
	WOVEN(width, any, t->kernel->degree)
DIMS(3)
DIMS(4)
DIMS(5)
DIMS(6)
DIMS(7)
DIMS(8)
#define ROW(name) {name##_3, name##_4, name##_5, name##_6, name##_7, name##_8}
#define TABLE(name) {ROW(name##_1), ROW(name##_2), ROW(name##_3)}
static pm_tile_loop *const spreads[2][3][6] = {TABLE(spread_spline), TABLE(spread_any)};
static pm_tile_loop *const gathers[2][3][6] = {TABLE(gather_spline), TABLE(gather_any)};
static pm_tile_spread_loop *const spread_batches[2][3][6] = {TABLE(spread_batch_spline), TABLE(spread_batch_any)};
static pm_tile_gather_loop *const gather_batches[2][3][6] = {TABLE(gather_batch_spline), TABLE(gather_batch_any)};
static pm_tile_loop *const wovens[2][6] = {ROW(woven_spline), ROW(woven_any)};

static bool is_wide(const struct pm_kernel *k) { return PM_TILE_CIC_EIGHT && k->width >= 3 && k->width <= most && !k->star; }

pm_tile_loop *pm_tile_spread_wide(int dim, const struct pm_kernel *k)
{
	return is_wide(k) ? spreads[k->degree != k->width - 1][dim - 1][k->width - 3] : NULL;
}

pm_tile_loop *pm_tile_gather_wide(int dim, const struct pm_kernel *k)
{
	return is_wide(k) ? gathers[k->degree != k->width - 1][dim - 1][k->width - 3] : NULL;
}

pm_tile_spread_loop *pm_tile_spread_wide_batch(int dim, const struct pm_kernel *k)
{
	return is_wide(k) ? spread_batches[k->degree != k->width - 1][dim - 1][k->width - 3] : NULL;
}

pm_tile_gather_loop *pm_tile_gather_wide_batch(int dim, const struct pm_kernel *k)
{
	return is_wide(k) ? gather_batches[k->degree != k->width - 1][dim - 1][k->width - 3] : NULL;
}

pm_tile_loop *pm_tile_gather_woven(const struct pm_kernel *k) { return is_wide(k) ? wovens[k->degree != k->width - 1][k->width - 3] : NULL; }
