/* What goes between the arrays of a mesh, node after node, and the rows of a hierarchy: even nodes, then odd ones.
 *   f = c (s - average);  phi = factor u - average
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-ranks.h"

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

/* A row of f from one of s, a sum of squares; nodes behind the last are the padding, which stays 0. */
static double load_row(const struct mg_level *l, double c, double average, const double *restrict s, double *restrict f)
{
	enum { lanes = 8 };
	const size_t n = l->axis[0].points;
	const mg_mask *even_mask = l->mask[0], *odd_mask = l->mask[1];
	double *odd = f + l->half, lane[lanes] = {0};
	size_t i = 0;
	for (; 2 * (i + lanes) <= n; i += lanes)
		for (size_t q = 0; q < lanes; q++) {
			/* Loaded in any case: gcc 12.2 misplaces masked loads with a step of 2. */
			const double here = c * (s[2 * (i + q)] - average), next = c * (s[2 * (i + q) + 1] - average);
			const double a = even_mask[i + q] ? here : 0, b = odd_mask[i + q] ? next : 0;
			f[i + q] = a, odd[i + q] = b;
			lane[q] += a * a + b * b;
		}
	for (size_t at = 2 * i; at < n; at++) {
		double *to = at & 1 ? odd + at / 2 : f + at / 2;
		*to = (at & 1 ? odd_mask : even_mask)[at / 2] ? c * (s[at] - average) : 0;
		lane[at / 2 - i] += *to * *to;
	}
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

/* f = c (s - average) on the unknowns, 0 elsewhere; of the single hierarchy too if cycles are in single numbers. Returns the sum of squares. */
double pm_mg_load(struct pm_mg *mg, double c, double average, const double *s, bool refines)
{
	struct mg_level *l = &mg->level[0];
	const struct mg_axis *y = &l->axis[1], *z = &l->axis[2];
	l->beside = false;
	#pragma omp parallel for num_threads(mg->threads) if (mg_held(l) > mg_parallel)
	for (size_t k = l->first; k < l->first + l->here; k++) {
		struct pm_sum sum = {0, 0};
		for (size_t j = 0; j < y->points; j++) {
			double *f = l->f + mg_plane(l, k) + j * l->stride;
			const bool inside = k >= z->first && k < z->end && j >= y->first && j < y->end;
			if (inside)
				pm_sum_add(&sum, load_row(l, c, average, s + ((k - l->first) * y->points + j) * l->axis[0].points, f));
			else
				memset(f, 0, l->stride * sizeof *f);
			if (inside && refines)
				pm_mg_refine_source(mg, 1, j, k, f);
		}
		mg->sums[k] = pm_sum_total(sum);
	}
	return pm_mg_total(mg, z->first, z->end);
}

/* phi = factor u - average */
void pm_mg_store(const struct pm_mg *mg, double factor, double average, double *phi)
{
	const struct mg_level *l = &mg->level[0];
	const struct mg_axis *x = &l->axis[0], *y = &l->axis[1];
	#pragma omp parallel for num_threads(mg->threads) if (mg_held(l) > mg_parallel)
	for (size_t k = l->first; k < l->first + l->here; k++)
		for (size_t j = 0; j < y->points; j++) {
			const double *restrict even = l->u + mg_plane(l, k) + j * l->stride, *restrict odd = even + l->half;
			double *restrict to = phi + ((k - l->first) * y->points + j) * x->points;
			for (size_t i = 0; i < x->points / 2; i++) {
				to[2 * i] = factor * even[i] - average;
				to[2 * i + 1] = factor * odd[i] - average;
			}
			if (x->points & 1)
				to[x->points - 1] = factor * even[x->points / 2] - average;
		}
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
