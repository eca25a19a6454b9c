/* The energy of the field of a law lap phi = c s, three ways: W = 1/2 sum q phi at the particles, 1/2 integral s phi on a mesh (which includes the
 * self-energy of the smoothed particles), and the direct sum over pairs W = sum_{i<j} q_i q_j c Phi(r_ij), lap Phi = delta function.
 * Sums are compensated and in the order of the stream (base/in-order.h). Cost N, mesh points, N^2/2. Source: Hockney, Eastwood 1988, section 5-5.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/measure.h"
#include "mesh/mesh-sum.h"
#include "stream/over-stretches.h"

enum { BATCH = 512 }; /* rows summed before their results are added to their block, which is a multiple; limits the memory, does not change the result */

double pm_energy_at_particles(const struct pm_measured *b)
{
	struct pm_sum all = {0, 0};
	if (b->field)
		pm_sum_of_stretches(b->field, b->strength, b->phi, &all);
	else
		pm_sum_of_set(b->n, b->strength, b->phi, &all);
	return 0.5 * pm_sum_total(all);
}

double pm_energy_on_mesh(const struct pm_grid *g, const double *rho, const double *phi)
{
	return 0.5 * pm_grid_cell(g) * pm_grid_sum(g, rho, phi);
}

double pm_energy_of_field(const struct pm_grid *g, const struct pm_field *field, const double *rho, const double *phi)
{
	const double half = 0.5 * pm_grid_cell(g);
	return half * pm_grid_sum_of(g, field, rho, phi);
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
	struct pm_sum all = {0}, block = {0};
	double batch[BATCH];
	for (size_t first = 0; first < a->n; first += BATCH) {
		const size_t n = a->n - first < BATCH ? a->n - first : BATCH;
#pragma omp parallel for schedule(dynamic, 8) if (a->n * b->n > 4096)
		for (size_t k = 0; k < n; k++)
			batch[k] = row_of_pairs(a, b, first + k, softening, potential);
		for (size_t k = 0; k < n; k++)
			pm_sum_add(&block, batch[k]);
		if ((first + n) % pm_sum_block == 0 || first + n == a->n) {
			pm_join_sums(sizeof block, &block, &all);
			block = (struct pm_sum){0, 0};
		}
	}
	return coefficient * pm_sum_total(all);
}
