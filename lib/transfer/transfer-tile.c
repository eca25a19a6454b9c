/* The loops over the particles of one tile. Dimension, width and degree of the kernel are constants of inline functions; the weights of all points
 * of an axis are found at once, so that widths 2, 4 and 8 fill a vector (3 and 6 are filled up with zeros). Block points are not wrapped: the faces are
 * handled when blocks are added to or read from the mesh (transfer.c). Cost: width^dim products per particle.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/tile-lanes.h"
#include "transfer/tile-line.h"
#include "transfer/tile-plane.h"
#include "transfer/tile-wide.h"

PM_SIMD_INLINE void spread(int dim, int width, int degree, const struct pm_tile *t)
{
	const int n = padded(width), row = pm_block_row[dim], plane = row * pm_block_rows[dim];
	double coefficients[(PM_KERNEL_DEGREE + 1) * lanes], w[3][lanes], f[lanes];
	pad_coefficients(t->kernel, width, degree, coefficients);
	for (size_t i = 0; i < t->count; i++) {
		const double *record = t->records + i * (size_t)t->stride;
		double *block = t->block + find_support(dim, width, degree, t, coefficients, record, w), q = record[t->value];
		for (int z = 0; z < (dim > 2 ? width : 1); z++) {
			row_set(dim > 1 ? n : 1, q * w[2][z], w[1], f);
			for (int y = 0; y < (dim > 1 ? width : 1); y++)
				row_add(n, f[y], w[0], block + z * plane + y * row);
		}
	}
}

/* The weights of the rows around a particle, and the place of the first. */
struct around {
	double f[lanes][lanes], x[lanes];
	size_t place;
};

PM_SIMD_INLINE void look_around(int dim, int width, int degree, const struct pm_tile *t, const double *coefficients, size_t i, struct around *a)
{
	double w[3][lanes];
	a->place = find_support(dim, width, degree, t, coefficients, t->records + i * (size_t)t->stride, w);
	row_set(padded(width), 1, w[0], a->x);
	for (int z = 0; z < (dim > 2 ? width : 1); z++)
		row_set(dim > 1 ? padded(width) : 1, w[2][z], w[1], a->f[z]);
}

/* Values from `n` blocks at once: a sum has the order of its rows, each waits for the one before it, and so others are made meanwhile. */
PM_SIMD_INLINE void read_rows(int dim, int width, int n, const struct around *const a[], const double *const block[], double *const to[])
{
	const int row = pm_block_row[dim], plane = row * pm_block_rows[dim], rows = dim > 1 ? width : 1;
	struct row sum[4];
	PM_SIMD_UNROLL
	for (int k = 0; k < n; k++)
		sum[k] = row_zero();
	for (int z = 0; z < (dim > 2 ? width : 1); z++)
		for (int y = 0; y < rows; y++) {
			PM_SIMD_UNROLL
			for (int k = 0; k < n; k++)
				row_more(padded(width), a[k]->f[z][y], block[k] + z * plane + y * row, &sum[k]);
		}
	PM_SIMD_UNROLL
	for (int k = 0; k < n; k++)
		*to[k] = row_sum(padded(width), width, &sum[k], a[k]->x);
}

/* One component at two particles. */
PM_SIMD_INLINE void gather_two(int dim, int width, int degree, const struct pm_tile *t, const double *coefficients, size_t i, size_t j)
{
	struct around one, other;
	look_around(dim, width, degree, t, coefficients, i, &one);
	look_around(dim, width, degree, t, coefficients, j, &other);
	read_rows(dim, width, 2, (const struct around *const[]){&one, &other}, (const double *const[]){t->block + one.place, t->block + other.place},
		(double *const[]){t->results + i * (size_t)t->to, t->results + j * (size_t)t->to});
}

/* All components at one particle, three at a time. */
PM_SIMD_INLINE void gather_several(int dim, int width, int degree, const struct pm_tile *t, const double *coefficients, size_t i)
{
	struct around a;
	const struct around *const same[] = {&a, &a, &a};
	double *result = t->results + i * (size_t)t->to;
	look_around(dim, width, degree, t, coefficients, i, &a);
	const double *block = t->block + a.place;
	int c = 0;
	for (; c + 3 <= t->components; c += 3, block += 3 * PM_BLOCK_MOST)
		read_rows(dim, width, 3, same, (const double *const[]){block, block + PM_BLOCK_MOST, block + 2 * PM_BLOCK_MOST},
			(double *const[]){result + c, result + c + 1, result + c + 2});
	for (; c < t->components; c++, block += PM_BLOCK_MOST)
		read_rows(dim, width, 1, same, &block, (double *const[]){result + c});
}

void pm_tile_order_cells(const struct pm_tile *t, size_t from, size_t m, uint16_t *index)
{
	enum { bits = 9, along_x = 12 - bits }; /* the points of some cells along x are a line or two of the cache */
	uint16_t key[PM_TILE_CELLS], at[(1 << bits) + 1] = {0};
	const int *shift = pm_tile_shift[3];
	for (size_t i = 0; i < m; i++) {
		pm_simd4_int_at cell;
		int32_t c[4];
		pm_simd4_split(*(const pm_simd4_at *)(t->records + (from + i) * (size_t)t->stride), &cell);
		*(pm_simd4_int_at *)c = cell;
		const int x = c[0] & ((1 << shift[0]) - 1), y = c[1] & ((1 << shift[1]) - 1), z = c[2] & ((1 << shift[2]) - 1), half = shift[0] - 1;
		key[i] = (uint16_t)((((z << 1 | x >> half) << shift[1] | y) << half | (x & ((1 << half) - 1))) >> along_x);
		at[key[i] + 1]++;
	}
	for (int k = 0; k < 1 << bits; k++)
		at[k + 1] = (uint16_t)(at[k + 1] + at[k]);
	for (size_t i = 0; i < m; i++)
		index[at[key[i]]++] = (uint16_t)i;
}

PM_SIMD_INLINE void gather(int dim, int width, int degree, const struct pm_tile *t)
{
	const bool wide = dim == 3 && width > 4 && t->components > 1; /* below, sorting costs more than it saves */
	double coefficients[(PM_KERNEL_DEGREE + 1) * lanes];
	uint16_t index[PM_TILE_CELLS];
	pad_coefficients(t->kernel, width, degree, coefficients);
	for (size_t from = 0; from < t->count; from += PM_TILE_CELLS) {
		const size_t m = t->count - from < PM_TILE_CELLS ? t->count - from : PM_TILE_CELLS;
		const bool sorted = wide && m >= 128;
		size_t i = 0;
		if (sorted)
			pm_tile_order_cells(t, from, m, index);
		for (; t->components == 1 && i + 2 <= m; i += 2)
			gather_two(dim, width, degree, t, coefficients, from + (sorted ? index[i] : i), from + (sorted ? index[i + 1] : i + 1));
		for (; i < m; i++)
			gather_several(dim, width, degree, t, coefficients, from + (sorted ? index[i] : i));
	}
}

/* The nearest point gets what its neighbours along the axes leave. */
PM_SIMD_INLINE double star_middle(int dim, double w[3][lanes])
{
	double middle = 1;
	for (int d = 0; d < dim; d++)
		middle -= w[d][0] + w[d][2];
	return middle;
}

PM_SIMD_INLINE void spread_star(int dim, const struct pm_tile *t)
{
	const int step[3] = {1, pm_block_row[dim], pm_block_row[dim] * pm_block_rows[dim]};
	double coefficients[(PM_KERNEL_DEGREE + 1) * lanes], w[3][lanes];
	pad_coefficients(t->kernel, 3, 2, coefficients);
	for (size_t i = 0; i < t->count; i++) {
		const double *record = t->records + i * (size_t)t->stride;
		double *middle = t->block + find_support(dim, 3, 2, t, coefficients, record, w), q = record[t->value];
		for (int d = 0; d < dim; d++)
			middle += step[d];
		*middle += q * star_middle(dim, w);
		for (int d = 0; d < dim; d++) {
			middle[-step[d]] += q * w[d][0];
			middle[step[d]] += q * w[d][2];
		}
	}
}

PM_SIMD_INLINE void gather_star(int dim, const struct pm_tile *t)
{
	const int step[3] = {1, pm_block_row[dim], pm_block_row[dim] * pm_block_rows[dim]};
	double coefficients[(PM_KERNEL_DEGREE + 1) * lanes], w[3][lanes];
	pad_coefficients(t->kernel, 3, 2, coefficients);
	for (size_t i = 0; i < t->count; i++) {
		const double *record = t->records + i * (size_t)t->stride;
		double *result = t->results + i * (size_t)t->to;
		size_t place = find_support(dim, 3, 2, t, coefficients, record, w);
		for (int d = 0; d < dim; d++)
			place += (size_t)step[d];
		for (int c = 0; c < t->components; c++) {
			const double *middle = t->block + (size_t)c * PM_BLOCK_MOST + place;
			double total = *middle * star_middle(dim, w);
			for (int d = 0; d < dim; d++)
				total += middle[-step[d]] * w[d][0] + middle[step[d]] * w[d][2];
			result[c] = total;
		}
	}
}

bool pm_tile_has_squares(int dim, const struct pm_kernel *k, size_t count)
{
	return dim != 2 && k->width == 2 && k->degree == 1 && count >= PM_TILE_CELLS / 4;
}

/* One function per dimension and width for the degree width-1 (B-splines, M'4 and M'6), and one for any degree. */
#define LOOPS(dim, width, name, degree) \
	static void spread_##name##_##dim##_##width(const struct pm_tile *t) { spread(dim, width, degree, t); } \
	static void gather_##name##_##dim##_##width(const struct pm_tile *t) { gather(dim, width, degree, t); }
#define DIMS(width) \
	LOOPS(1, width, spline, width - 1) LOOPS(2, width, spline, width - 1) LOOPS(3, width, spline, width - 1) \
	LOOPS(1, width, any, t->kernel->degree) LOOPS(2, width, any, t->kernel->degree) LOOPS(3, width, any, t->kernel->degree)
DIMS(1)
DIMS(2)
DIMS(3)
DIMS(4)
DIMS(5)
DIMS(6)
DIMS(7)
DIMS(8)
DIMS(9)
DIMS(10)
#define STAR(dim) \
	static void spread_star_##dim(const struct pm_tile *t) { spread_star(dim, t); } \
	static void gather_star_##dim(const struct pm_tile *t) { gather_star(dim, t); }
STAR(1)
STAR(2)
STAR(3)
static pm_tile_loop *const star_spreads[3] = {spread_star_1, spread_star_2, spread_star_3};
static pm_tile_loop *const star_gathers[3] = {gather_star_1, gather_star_2, gather_star_3};
#define ROW(name, dim) {name##_##dim##_1, name##_##dim##_2, name##_##dim##_3, name##_##dim##_4, name##_##dim##_5, name##_##dim##_6, name##_##dim##_7, \
	name##_##dim##_8, name##_##dim##_9, name##_##dim##_10}
#define TABLE(name) {ROW(name, 1), ROW(name, 2), ROW(name, 3)}
static pm_tile_loop *const spreads[2][3][PM_KERNEL_WIDTH] = {TABLE(spread_spline), TABLE(spread_any)};
static pm_tile_loop *const gathers[2][3][PM_KERNEL_WIDTH] = {TABLE(gather_spline), TABLE(gather_any)};

pm_tile_loop *pm_tile_spread(int dim, const struct pm_kernel *k, bool squares)
{
	if (squares && dim == 1)
		return pm_tile_line_spread_records;
	if (squares)
		return PM_TILE_CIC_EIGHT ? pm_tile_cic_spread_eight : pm_tile_cic_spread_records;
	if (pm_tile_has_plane(dim, k))
		return pm_tile_plane_spread_records;
	pm_tile_loop *wide = pm_tile_spread_wide(dim, k);
	return wide ? wide : k->star ? star_spreads[dim - 1] : spreads[k->degree != k->width - 1][dim - 1][k->width - 1];
}

pm_tile_loop *pm_tile_gather(int dim, const struct pm_kernel *k)
{
	if (pm_tile_has_plane(dim, k))
		return pm_tile_plane_gather_records;
	pm_tile_loop *wide = pm_tile_gather_wide(dim, k);
	return wide ? wide : k->star ? star_gathers[dim - 1] : gathers[k->degree != k->width - 1][dim - 1][k->width - 1];
}
