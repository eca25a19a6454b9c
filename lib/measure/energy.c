/* The energy of the field of a law lap phi = c s, three ways: W = 1/2 sum q phi at the particles, 1/2 integral s phi on a mesh (which includes the
 * self-energy of the smoothed particles), and the direct sum over pairs W = sum_{i<j} q_i q_j c Phi(r_ij), lap Phi = delta function.
 * Rows are summed with compensation and added in a fixed order. Cost N, mesh points, N^2/2. Source: Hockney, Eastwood 1988, section 5-5.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/measure.h"
#include "base/simd-sum.h"

enum { BATCH = 512 }; /* rows summed before their results are added; limits the memory, does not change the result */

double pm_energy_at_particles(const struct pm_measured *b) { return 0.5 * pm_sum_products(b->n, b->strength, b->phi); }

/* Weighted sum of rho phi along the row (j, k): its two ends, and the points between them eight at a time. */
static double row_on_mesh(const struct pm_grid *g, const double *rho, const double *phi, size_t row)
{
	const size_t n = g->points[0], j = row % g->points[1], k = row / g->points[1];
	struct pm_sum sum = {0};
	struct pm_simd_sum inner = {0};
	const double *s = rho + row * n, *p = phi + row * n;
	size_t i = 1;
	pm_simd weight = pm_simd_all(pm_grid_weight(g, n > 2, j, k));
	for (; i + PM_SIMD_WIDTH < n; i += PM_SIMD_WIDTH)
		pm_simd_sum_add(&inner, weight * pm_simd_load_any(s + i) * pm_simd_load_any(p + i));
	if (i + 1 < n)
		pm_simd_sum_add(&inner, weight * pm_simd_load_few(s + i, n - 1 - i) * pm_simd_load_few(p + i, n - 1 - i));
	pm_simd_sum_join(&sum, &inner);
	pm_sum_add(&sum, pm_grid_weight(g, 0, j, k) * s[0] * p[0]);
	if (n > 1)
		pm_sum_add(&sum, pm_grid_weight(g, n - 1, j, k) * s[n - 1] * p[n - 1]);
	return pm_sum_total(sum);
}

double pm_energy_on_mesh(const struct pm_grid *g, const double *rho, const double *phi)
{
	struct pm_sum all = {0};
	double batch[BATCH];
	const size_t rows = g->points[1] * g->points[2];
	for (size_t first = 0; first < rows; first += BATCH) {
		const size_t n = rows - first < BATCH ? rows - first : BATCH;
#pragma omp parallel for schedule(static) if (n * g->points[0] > 4096)
		for (size_t k = 0; k < n; k++)
			batch[k] = row_on_mesh(g, rho, phi, first + k);
		for (size_t k = 0; k < n; k++)
			pm_sum_add(&all, batch[k]);
	}
	return 0.5 * pm_grid_cell(g) * pm_sum_total(all);
}

/* Sum over the partners j of particle i of a. */
static double row_of_pairs(const struct pm_measured *a, const struct pm_measured *b, size_t i, double softening,
	double (*potential)(double r2, double softening, int dim))
{
	struct pm_sum sum = {0};
	for (size_t j = a == b ? i + 1 : 0; j < b->n; j++) {
		double r2 = 0;
		for (int d = 0; d < a->dim; d++)
			r2 += (a->x[d][i] - b->x[d][j]) * (a->x[d][i] - b->x[d][j]);
		pm_sum_add(&sum, b->strength[j] * potential(r2, softening, a->dim));
	}
	return a->strength[i] * pm_sum_total(sum);
}

double pm_energy_of_pairs(const struct pm_measured *a, const struct pm_measured *b, double coefficient, double softening,
	double (*potential)(double r2, double softening, int dim))
{
	struct pm_sum all = {0};
	double batch[BATCH];
	for (size_t first = 0; first < a->n; first += BATCH) {
		const size_t n = a->n - first < BATCH ? a->n - first : BATCH;
#pragma omp parallel for schedule(dynamic, 8) if (a->n * b->n > 4096)
		for (size_t k = 0; k < n; k++)
			batch[k] = row_of_pairs(a, b, first + k, softening, potential);
		for (size_t k = 0; k < n; k++)
			pm_sum_add(&all, batch[k]);
	}
	return coefficient * pm_sum_total(all);
}
