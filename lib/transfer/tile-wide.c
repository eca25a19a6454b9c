/* Gather and spread by kernels of three to eight points. As many particles as a register has lanes find their cells, the weights of their points, and the
 * products of these for the rows around them (y, z) together, a particle a lane. A value is then the sum of its rows, times these products, and the sums of
 * all particles are made at once, because one waits for the row before it; what is left, a number for every point along x, is turned into lanes again and
 * multiplied by the weights along x. Of a vector in 3-D all components of a node are one load (tile-vector.h). Every sum has the order of the loops for all
 * kernels (transfer-tile.c): the same bytes. Cost: width^dim products per particle and component. SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/tile-eight.h"
#include "transfer/tile-lanes.h"
#include "transfer/tile-vector.h"
#include "transfer/tile-wide.h"

enum { node_row = PM_NODE_ROW, node_plane = PM_NODE_PLANE, most = 8 /* points */ };

/* Particles side by side: their first points, and their weights. */
struct lot {
	size_t at[PM_SIMD_WIDTH];
	double x[most * PM_SIMD_WIDTH] __attribute__((aligned(64)));        /* [point][particle] */
	double f[most * most * PM_SIMD_WIDTH] __attribute__((aligned(64))); /* [z][y][particle] */
};

/* w[k] of point k: those of find_weights (tile-lanes.h) to the last bit. */
PM_SIMD_INLINE void weights_of(const struct pm_kernel *kernel, int width, int degree, pm_simd t, pm_simd *w)
{
	const bool may_fold = pm_kernel_folds(width, degree, 1);
	const pm_simd_bits fold = t > 0.5;
	const pm_simd s = may_fold ? (pm_simd)((fold & (pm_simd_bits)(1 - t)) | (~fold & (pm_simd_bits)t)) : t;
	pm_simd v[most];
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++) {
		v[k] = pm_simd_all(kernel->coefficients[degree * width + k]);
		for (int power = degree - 1; power >= 0; power--)
			v[k] = v[k] * s + kernel->coefficients[power * width + k];
	}
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++)
		w[k] = may_fold ? (pm_simd)((fold & (pm_simd_bits)v[width - 1 - k]) | (~fold & (pm_simd_bits)v[k])) : v[k];
}

/* The particles of index[], with the number of doubles from point to point; strength: of spread, where the product of rows has it, or NULL. */
PM_SIMD_INLINE void find_lot(int dim, int width, int degree, const struct pm_tile *t, const size_t *index, int each, const pm_simd *strength, struct lot *lot)
{
	const int row = pm_block_row[dim], plane = row * pm_block_rows[dim];
	const double *record[PM_SIMD_WIDTH];
	pm_simd w[3][most], unused;
	int32_t at[PM_SIMD_WIDTH] __attribute__((aligned(32)));
	PM_SIMD_UNROLL
	for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
		record[l] = t->records + index[l] * (size_t)t->stride;
	struct eight e = find_eight_at(t, record, &unused);
	for (int d = 0; d < dim; d++)
		weights_of(t->kernel, width, degree, e.distance[d] - t->shift, w[d]);
	*(pm_simd_int_at *)at = (e.cell[0] + e.cell[1] * (dim > 1 ? row : 0) + e.cell[2] * (dim > 2 ? plane : 0)) * each;
	PM_SIMD_UNROLL
	for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
		lot->at[l] = (size_t)(uint32_t)at[l];
	PM_SIMD_UNROLL
	for (int k = 0; k < width; k++)
		pm_simd_store(lot->x + k * PM_SIMD_WIDTH, w[0][k]);
	for (int z = 0; z < (dim > 2 ? width : 1); z++) {
		pm_simd f = dim > 2 ? w[2][z] : pm_simd_all(1);
		f = strength ? *strength * f : f;
		for (int y = 0; y < (dim > 1 ? width : 1); y++)
			pm_simd_store(lot->f + (z * width + y) * PM_SIMD_WIDTH, dim > 1 ? f * w[1][y] : f);
	}
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

PM_SIMD_INLINE void spread(int dim, int width, int degree, const struct pm_tile *t)
{
	const int n = points_many(width), across = pm_block_row[dim], plane = across * pm_block_rows[dim];
	struct lot lot;
	double row[PM_SIMD_WIDTH][most] __attribute__((aligned(64))), *block = t->block;
	for (size_t i = 0; i < t->count; i += PM_SIMD_WIDTH) {
		const size_t m = t->count - i < PM_SIMD_WIDTH ? t->count - i : PM_SIMD_WIDTH;
		size_t index[PM_SIMD_WIDTH];
		pm_simd strength;
		for (size_t l = 0; l < PM_SIMD_WIDTH; l++) {
			index[l] = i + (l < m ? l : 0);
			strength[l] = t->records[index[l] * (size_t)t->stride + (size_t)t->value];
		}
		find_lot(dim, width, degree, t, index, 1, &strength, &lot);
		rows_of_lot(width, &lot, row);
		for (size_t l = 0; l < m; l++) {
			const struct points x = points_of(n, row[l]);
			double *to = block + lot.at[l];
			for (int z = 0; z < (dim > 2 ? width : 1); z++)
				for (int y = 0; y < (dim > 1 ? width : 1); y++) {
					const double f = lot.f[(size_t)(z * width + y) * PM_SIMD_WIDTH + l];
					points_add(n, factor_of(width <= 4, f), &x, to + z * plane + y * across);
				}
		}
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
	for (int z = 0; z < (dim > 2 ? width : 1); z++)
		for (int y = 0; y < rows; y++) {
			PM_SIMD_UNROLL
			for (int l = 0; l < PM_SIMD_WIDTH; l++) {
				const double f = lot->f[(z * width + y) * PM_SIMD_WIDTH + l];
				points_more(n, factor_of(held, f), block + lot->at[l] + z * plane + y * row, &sum[l]);
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

/* All components of a node: at particle l. */
PM_SIMD_INLINE pm_simd4_at node_value(int width, const struct lot *lot, size_t l, const double *nodes)
{
	const double *from = nodes + lot->at[l];
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
	const double *from = nodes + lot->at[l];
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

PM_SIMD_INLINE void gather(int dim, int width, int degree, bool woven, const struct pm_tile *t)
{
	const bool sorts = woven && width > 3; /* of one component, or few points, sorting costs more than it saves */
	uint16_t order[PM_TILE_CELLS];
	struct lot lot;
	for (size_t from = 0; from < t->count; from += PM_TILE_CELLS) {
		const size_t m = t->count - from < PM_TILE_CELLS ? t->count - from : PM_TILE_CELLS;
		const bool sorted = sorts && m >= 128;
		if (sorted)
			pm_tile_order_cells(t, from, m, order);
		for (size_t i = 0; i < m; i += PM_SIMD_WIDTH) {
			const size_t n = m - i < PM_SIMD_WIDTH ? m - i : PM_SIMD_WIDTH;
			size_t index[PM_SIMD_WIDTH];
			for (size_t l = 0; l < PM_SIMD_WIDTH; l++) /* the last ones may be fewer: the first of them stands in for the rest */
				index[l] = from + (sorted ? order[i + (l < n ? l : 0)] : i + (l < n ? l : 0));
			find_lot(dim, width, degree, t, index, woven ? 4 : 1, NULL, &lot);
			for (int c = 0; c < t->components && !woven; c++) {
				const pm_simd value = value_of(dim, width, &lot, t->block + (size_t)c * PM_BLOCK_MOST);
				for (size_t l = 0; l < n; l++)
					t->results[index[l] * (size_t)t->to + (size_t)c] = value[l];
			}
			const int group = pm_vector_group(t->components);
			const double *nodes = t->nodes;
			for (int c = 0; c < t->components && woven; c += group, nodes += PM_VECTOR_NODES)
				for (size_t l = 0; l < n; l++)
					put(t->results + index[l] * (size_t)t->to + c, t->components - c < group ? t->components - c : group, t->to - c,
						(int)PM_SIMD_PART == 8 && width > 3 ? pair_value(width, &lot, l, nodes) : node_value(width, &lot, l, nodes));
		}
	}
}

#define LOOPS(dim, width, name, degree) \
	static void spread_##name##_##dim##_##width(const struct pm_tile *t) { spread(dim, width, degree, t); } \
	static void gather_##name##_##dim##_##width(const struct pm_tile *t) { gather(dim, width, degree, false, t); }
#define WOVEN(width, name, degree) static void woven_##name##_##width(const struct pm_tile *t) { gather(3, width, degree, true, t); }
#define DIMS(width) \
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

pm_tile_loop *pm_tile_gather_woven(const struct pm_kernel *k) { return is_wide(k) ? wovens[k->degree != k->width - 1][k->width - 3] : NULL; }
