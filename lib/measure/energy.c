/* The energy of the field of a law lap phi = c s, three ways: W = 1/2 sum q phi at the particles, 1/2 integral s phi on a mesh (which includes the
 * self-energy of the smoothed particles), and the direct sum over pairs W = sum_{i<j} q_i q_j c Phi(r_ij), lap Phi = delta function.
 * Sums are compensated and in the order of the stream (base/in-order.h). Cost N, mesh points, N^2/2. Source: Hockney, Eastwood 1988, section 5-5.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/measure.h"
#include "mesh/mesh-sum.h"
#include "stream/all-values.h"
#include "stream/over-stretches.h"
#include "world/world.h"

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

/* Sum over the partners j of particle i of a, of which the first here is number `first` of the set. */
static double row_of_pairs(const struct pm_measured *a, const struct pm_measured *b, size_t first, size_t i, bool same, double softening,
	double (*potential)(double r2, double softening, int dim))
{
	struct pm_sum sum = {0};
	for (size_t j = same ? first + i + 1 : 0; j < b->n; j++) {
		double r2 = 0;
		for (int d = 0; d < a->dim; d++)
			r2 += (a->x[d][i] - b->x[d][j]) * (a->x[d][i] - b->x[d][j]);
		pm_sum_add(&sum, b->strength[j] * potential(r2, softening, a->dim));
	}
	return a->strength[i] * pm_sum_total(sum);
}

static void make_rows(const void *data, size_t from, size_t to, void *part)
{
	for (const double *row = data; from < to; from++)
		pm_sum_add(part, row[from]);
}

/* A set whole: with ranks that share it, what the others have of it is brought. room: to be freed. */
static int whole_of(const struct pm_measured *b, struct pm_measured *all, double **room)
{
	*all = *b, *room = NULL;
	if (!b->field)
		return 0;
	*room = pm_alloc((size_t)(b->dim + 1) * b->all + 1, sizeof **room);
	int status = pm_world_agree(*room ? 0 : -PM_DATA);
	for (int d = 0; d <= b->dim; d++) {
		double *to = *room ? *room + (size_t)d * b->all : NULL;
		status = pm_all_values(status, b->field, d < b->dim ? b->x[d] : b->strength, to);
		*(d < b->dim ? &all->x[d] : &all->strength) = to;
	}
	all->n = b->all;
	return status;
}

double pm_energy_of_pairs(const struct pm_measured *a, const struct pm_measured *b, double coefficient, double softening,
	double (*potential)(double r2, double softening, int dim))
{
	const struct pm_parts parts = {.size = sizeof(struct pm_sum), .make = make_rows, .join = pm_join_sums};
	const size_t first = a->field ? (size_t)a->field->first : 0;
	struct pm_sum all = {0, 0};
	struct pm_measured partners;
	double *room, *row = pm_alloc(a->n + 1, sizeof *row);
	int status = whole_of(b, &partners, &room);
	status = a->field ? pm_world_agree(status ? status : row ? 0 : -PM_DATA) : status ? status : row ? 0 : -PM_DATA;
	if (!status) {
#pragma omp parallel for schedule(dynamic, 8) if (a->n * partners.n > 4096)
		for (size_t i = 0; i < a->n; i++)
			row[i] = row_of_pairs(a, &partners, first, i, a == b, softening, potential);
		if (a->field)
			pm_over_stretches(a->field, &parts, row, &all);
		else
			pm_over_set(&parts, row, a->n, &all);
	}
	pm_free(row), pm_free(room);
	return status ? NAN : coefficient * pm_sum_total(all);
}
