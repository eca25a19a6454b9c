/* Parts of sets and meshes, and their join in the order of the stream (docs/distributed.md). Lots of parts are made by all threads, then joined one by one,
 * so neither the threads nor the size of a lot change a result. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "base/in-order.h"
#include "base/simd-sum.h"

enum { WORTH = 16384, AHEAD = 256 }; /* values below which threads are not worth it; prefetched, so many ahead */

static void clear(const struct pm_parts *p, void *part)
{
	if (p->none)
		memcpy(part, p->none, p->size);
	else
		memset(part, 0, p->size);
}

static void *part_at(const struct pm_parts *p, void *parts, size_t i) { return (char *)parts + i * p->size; }

void pm_join_sums(size_t size, const void *part, void *all)
{
	const struct pm_sum *from = part;
	struct pm_sum *to = all;
	for (size_t s = 0; s < size / sizeof *to; s++) {
		pm_sum_add(&to[s], from[s].sum);
		pm_sum_add(&to[s], from[s].carry);
	}
}

void pm_join_parts(const struct pm_parts *p, size_t count, const void *parts, void *all)
{
	for (size_t i = 0; i < count; i++)
		p->join(p->size, (const char *)parts + i * p->size, all);
}

void pm_parts_of_blocks(const struct pm_parts *p, const void *data, size_t n, size_t block, size_t first, size_t count, void *parts)
{
#pragma omp parallel for schedule(static) if (count > 1 && count * block > WORTH)
	for (size_t b = 0; b < count; b++) {
		const size_t from = (first + b) * block;
		clear(p, part_at(p, parts, b));
		p->make(data, from, n - from < block ? n : from + block, part_at(p, parts, b));
	}
}

/* The rows of a plane, joined. */
static void plane_of(const struct pm_parts *p, const void *data, size_t points, size_t row, size_t rows, void *plane)
{
	double one[PM_PART_MOST / sizeof(double)];
	for (size_t end = row + rows; row < end; row++) {
		clear(p, one);
		p->make(data, row * points, (row + 1) * points, one);
		p->join(p->size, one, plane);
	}
}

void pm_parts_of_mesh(const struct pm_parts *p, const void *data, const size_t points[3], size_t first, size_t count, void *parts)
{
	const size_t rows = points[2] > 1 ? points[1] : 1;
#pragma omp parallel for schedule(static) if (count > 1 && count * rows * points[0] > WORTH)
	for (size_t k = 0; k < count; k++) {
		clear(p, part_at(p, parts, k));
		if (points[2] > 1)
			plane_of(p, data, points[0], (first + k) * rows, rows, part_at(p, parts, k));
		else
			p->make(data, (first + k) * points[0], (first + k + 1) * points[0], part_at(p, parts, k));
	}
}

void pm_over_set(const struct pm_parts *p, const void *data, size_t n, void *all)
{
	double lot[8192];
	const size_t blocks = (n + pm_sum_block - 1) / pm_sum_block, most = sizeof lot / p->size;
	for (size_t first = 0; first < blocks; first += most) {
		const size_t count = blocks - first < most ? blocks - first : most;
		pm_parts_of_blocks(p, data, n, pm_sum_block, first, count, lot);
		pm_join_parts(p, count, lot, all);
	}
}

void pm_over_mesh(const struct pm_parts *p, const void *data, const size_t points[3], void *all)
{
	double lot[8192], plane[PM_PART_MOST / sizeof(double)];
	const size_t parts = points[2] > 1 ? points[2] : points[1], most = sizeof lot / p->size;
	clear(p, plane);
	for (size_t first = 0; first < parts; first += most) {
		const size_t count = parts - first < most ? parts - first : most;
		pm_parts_of_mesh(p, data, points, first, count, lot);
		pm_join_parts(p, count, lot, points[2] > 1 ? all : plane); /* in 2-D the rows are those of the only plane */
	}
	if (points[2] <= 1)
		p->join(p->size, plane, all);
}

/* ---- sums of values and of products ---- */

struct values {
	const double *x, *y;
};

/* weight times n values, eight sums side by side; a loop for values and one for products. */
PM_SIMD_INLINE void add_some(size_t n, double weight, const double *x, const double *y, bool products, struct pm_sum *sum)
{
	enum { P = PM_SIMD_PART, PARTS = PM_SIMD_WIDTH / P };
	struct pm_simd_sum s;
	pm_simd_part sum_of[PARTS] = {{0}}, carry[PARTS] = {{0}};
	const pm_simd w = pm_simd_all(weight);
	size_t i = 0;
	for (; i + PM_SIMD_WIDTH <= n; i += PM_SIMD_WIDTH) {
		__builtin_prefetch(x + i + AHEAD, 0, 2);
		if (products)
			__builtin_prefetch(y + i + AHEAD, 0, 2);
		PM_SIMD_UNROLL
		for (int q = 0; q < PARTS; q++) { /* in registers */
			pm_simd_part a, b;
			memcpy(&a, x + i + q * P, sizeof a);
			memcpy(&b, (products ? y : x) + i + q * P, sizeof b);
			pm_simd_part_sum_add(&sum_of[q], &carry[q], weight * (products ? a * b : a));
		}
	}
	memcpy(&s.sum, sum_of, sizeof s.sum), memcpy(&s.carry, carry, sizeof s.carry);
	if (i < n)
		pm_simd_sum_add(&s, w * (products ? pm_simd_load_few(x + i, n - i) * pm_simd_load_few(y + i, n - i) : pm_simd_load_few(x + i, n - i)));
	pm_simd_sum_join(sum, &s);
}

static void add_values(size_t n, double weight, const double *x, const double *y, struct pm_sum *sum)
{
	if (y)
		add_some(n, weight, x, y, true, sum);
	else
		add_some(n, weight, x, y, false, sum);
}

static void block_of(const void *data, size_t from, size_t to, void *part)
{
	const struct values *v = data;
	add_values(to - from, 1, v->x + from, v->y ? v->y + from : NULL, part);
}

static void row_of(const void *data, size_t from, size_t to, void *part)
{
	const struct pm_mesh_values *v = data;
	const size_t n = to - from, row = v->row + from / n, at[2] = {row % v->points[1], row / v->points[1]};
	const double *x = v->x + from, *y = v->y ? v->y + from : NULL;
	double weight = 1;
	for (int d = 1; d < 3 && v->end; d++)
		weight *= at[d - 1] == 0 ? v->end[d][0] : at[d - 1] + 1 == v->points[d] ? v->end[d][1] : 1;
	const bool first = v->end && v->end[0][0] != 1, last = v->end && v->end[0][1] != 1 && n > 1;
	add_values(n - first - last, weight, x + first, y ? y + first : NULL, part);
	if (first)
		pm_sum_add(part, weight * v->end[0][0] * (y ? x[0] * y[0] : x[0]));
	if (last)
		pm_sum_add(part, weight * v->end[0][1] * (y ? x[n - 1] * y[n - 1] : x[n - 1]));
}

void pm_sum_of_set(size_t n, const double *x, const double *y, struct pm_sum *all)
{
	const struct pm_parts p = {.size = sizeof *all, .make = block_of, .join = pm_join_sums};
	pm_over_set(&p, &(struct values){.x = x, .y = y}, n, all);
}

const struct pm_parts pm_mesh_sums = {.size = sizeof(struct pm_sum), .make = row_of, .join = pm_join_sums};

void pm_sum_of_mesh(const size_t points[3], const double *x, const double *y, const double end[3][2], struct pm_sum *all)
{
	pm_over_mesh(&pm_mesh_sums, &(struct pm_mesh_values){.x = x, .y = y, .points = points, .end = end}, points, all);
}

static void plane_of_rows(const void *data, size_t from, size_t to, void *part)
{
	for (size_t row = from; row < to; row++)
		pm_sum_add(part, ((const double *)data)[row]);
}

/* Rows lie one behind the other: planes are blocks of them. */
double pm_sum_of_rows(const size_t points[3], const double *row)
{
	const struct pm_parts p = {.size = sizeof(struct pm_sum), .make = plane_of_rows, .join = pm_join_sums};
	struct pm_sum all = {0, 0}, lot[1024];
	for (size_t first = 0, most = sizeof lot / sizeof *lot; first < points[2]; first += most) {
		const size_t count = points[2] - first < most ? points[2] - first : most;
		pm_parts_of_blocks(&p, row, points[1] * points[2], points[1], first, count, lot);
		pm_join_parts(&p, count, lot, &all);
	}
	return pm_sum_total(all);
}

static void number_of_row(const void *data, size_t from, size_t to, void *part)
{
	const struct pm_row_values *v = data;
	(void)to;
	pm_sum_add(part, v->row[from / v->points]);
}

const struct pm_parts pm_row_sums = {.size = sizeof(struct pm_sum), .make = number_of_row, .join = pm_join_sums};
