/* What goes between the arrays of a mesh, node after node, and the rows of a hierarchy: even nodes, then odd ones.
 *   f = c (s - average);  phi = factor u - average
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-vector.h"
#include "poisson-mg/mg-ranks.h"

#include <omp.h>
#include <string.h>

static double half(const struct mg_axis *a, size_t i) { return !a->periodic && (i == 0 || i + 1 == a->points) ? 0.5 : 1; }

/* With the weights of quadrature; rows and planes are added in order. */
double pm_mg_mean(struct pm_mg *mg, const double *values)
{
	const struct mg_level *l = &mg->level[0];
	const struct mg_axis *x = &l->axis[0], *y = x + 1, *z = x + 2;
	#pragma omp parallel for num_threads(mg->threads) if (mg_held(l) > mg_parallel)
	for (size_t k = l->first; k < l->first + l->here; k++) {
		struct pm_sum plane = {0};
		for (size_t j = 0; j < y->points; j++) {
			const double *v = values + ((k - l->first) * y->points + j) * x->points;
			double sum = x->periodic ? 0 : -0.5 * (v[0] + v[x->points - 1]);
			for (size_t i = 0; i < x->points; i++)
				sum += v[i];
			pm_sum_add(&plane, half(y, j) * sum);
		}
		mg->sums[k] = half(z, k) * pm_sum_total(plane);
	}
	return pm_mg_total(mg, 0, z->points) / ((double)x->cells * (double)y->cells * (double)z->cells);
}

/* The larger of a and |b|; a where b is not a number. */
PM_SIMD_INLINE pm_simd larger_size(pm_simd a, pm_simd b)
{
	const pm_simd size = (pm_simd)((pm_simd_bits)b & INT64_MAX);
	const pm_simd_bits more = size > a;
	return (pm_simd)((more & (pm_simd_bits)size) | (~more & (pm_simd_bits)a));
}

/* A row of f from one of s; nodes behind the last are the padding, which stays 0. Returns the sum of squares and makes `largest` as large as a value. */
double pm_mg_load_row(const struct mg_level *l, double c, double average, const double *restrict s, double *restrict f, double *largest)
{
	enum { lanes = 8 };
	const size_t n = l->axis[0].points;
	const mg_mask *even_mask = l->mask[0], *odd_mask = l->mask[1];
	double *odd = f + l->half, lane[lanes], most[lanes];
	pm_simd sum[lanes / W] = {{0}}, high[lanes / W] = {{0}};
	size_t i = 0;
	for (; 2 * (i + lanes) <= n; i += lanes)
		PM_SIMD_UNROLL
		for (size_t part = 0; part < lanes / W; part++) {
			const size_t at = i + part * W;
			pm_simd low, next, a, b;
			memcpy(&low, s + 2 * at, sizeof low), memcpy(&next, s + 2 * at + W, sizeof next);
			low = c * (low - average), next = c * (next - average);
			a = pm_simd_masked(pm_simd_even(low, next), even_mask + at), b = pm_simd_masked(pm_simd_odd(low, next), odd_mask + at);
			pm_simd_store(f + at, a), pm_simd_store(odd + at, b);
			sum[part] += a * a + b * b;
			high[part] = larger_size(high[part], a), high[part] = larger_size(high[part], b);
		}
	memcpy(lane, sum, sizeof lane), memcpy(most, high, sizeof most);
	for (size_t at = 2 * i; at < n; at++) {
		double *to = at & 1 ? odd + at / 2 : f + at / 2;
		*to = (at & 1 ? odd_mask : even_mask)[at / 2] ? c * (s[at] - average) : 0;
		lane[at / 2 - i] += *to * *to;
		most[0] = fmax(most[0], fabs(*to));
	}
	for (size_t q = 0; q < lanes; q++)
		*largest = most[q] > *largest ? most[q] : *largest;
	return ((lane[0] + lane[4]) + (lane[1] + lane[5])) + ((lane[2] + lane[6]) + (lane[3] + lane[7]));
}

/* u = 0 on the planes here. */
void pm_mg_clear(struct pm_mg *mg)
{
	struct mg_level *l = &mg->level[0];
	#pragma omp parallel for num_threads(mg->threads) if (mg_held(l) > mg_parallel)
	for (size_t k = l->first; k < l->first + l->here; k++)
		memset(l->u + mg_plane(l, k), 0, l->axis[1].points * l->stride * sizeof *l->u);
}

/* f = c (s - average) on the unknowns, 0 elsewhere. */
double pm_mg_load(struct pm_mg *mg, double c, double average, const double *s, int to, double *largest)
{
	const bool own = to & MG_LOAD_OWN;
	double most = 0;
	struct mg_level *l = &mg->level[0];
	const struct mg_axis *y = &l->axis[1], *z = &l->axis[2];
	l->beside = false;
	#pragma omp parallel for num_threads(mg->threads) reduction(max : most) if (mg_held(l) > mg_parallel)
	for (size_t k = l->first; k < l->first + l->here; k++) {
		struct pm_sum sum = {0, 0};
		for (size_t j = 0; j < y->points; j++) {
			double *f = own ? l->f + mg_plane(l, k) + j * l->stride : mg->scratch + (size_t)omp_get_thread_num() * mg->room;
			const bool inside = k >= z->first && k < z->end && j >= y->first && j < y->end;
			if (inside)
				pm_sum_add(&sum, pm_mg_load_row(l, c, average, s + ((k - l->first) * y->points + j) * l->axis[0].points, f, &most));
			else if (own)
				memset(f, 0, l->stride * sizeof *f);
			if (inside && to & MG_LOAD_SINGLE)
				pm_mg_refine_source(mg, 1, j, k, f);
		}
		mg->sums[k] = pm_sum_total(sum);
	}
	*largest = most;
	return pm_mg_total(mg, z->first, z->end);
}

/* A row of phi = factor u - average. */
void pm_mg_store_row(const struct mg_level *l, double factor, double average, const double *restrict u, double *restrict to)
{
	const size_t n = l->axis[0].points;
	const double *restrict odd = u + l->half;
	for (size_t i = 0; i < n / 2; i++) {
		to[2 * i] = factor * u[i] - average;
		to[2 * i + 1] = factor * odd[i] - average;
	}
	if (n & 1)
		to[n - 1] = factor * u[n / 2] - average;
}

void pm_mg_store(const struct pm_mg *mg, double factor, double average, double *phi)
{
	const struct mg_level *l = &mg->level[0];
	const struct mg_axis *x = &l->axis[0], *y = &l->axis[1];
	#pragma omp parallel for num_threads(mg->threads) if (mg_held(l) > mg_parallel)
	for (size_t k = l->first; k < l->first + l->here; k++)
		for (size_t j = 0; j < y->points; j++)
			pm_mg_store_row(l, factor, average, l->u + mg_plane(l, k) + j * l->stride, phi + ((k - l->first) * y->points + j) * x->points);
}

/* The largest |c (s - average)|. */
double pm_mg_largest(size_t n, double c, double average, const double *s)
{
	enum { lanes = 8, lot = 4096 };
	double most = 0;
	#pragma omp parallel for num_threads(pm_threads()) reduction(max : most) if (n > mg_parallel)
	for (size_t from = 0; from < n; from += lot) {
		const size_t to = from + lot < n ? from + lot : n;
		double lane[lanes] = {0};
		size_t i = from;
		for (; i + lanes <= to; i += lanes)
			for (size_t q = 0; q < lanes; q++) {
				const double v = fabs(c * (s[i + q] - average));
				lane[q] = v > lane[q] ? v : lane[q];
			}
		for (; i < to; i++)
			lane[0] = fmax(lane[0], fabs(c * (s[i] - average)));
		for (size_t q = 0; q < lanes; q++)
			most = lane[q] > most ? lane[q] : most;
	}
	return most;
}
