/* mgrad and the energy of the field in diag, as a fraction of the bandwidth of a plain loop of the same kind in the same rounds.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "bandwidth.h"

#include "measure/measure.h"
#include "mesh/gradient.h"

enum { CELLS = 192 }; /* whole pieces */

struct mesh {
	struct pm_operator o;
	double *phi, *rho, *g[3];
};

static void gradient(void *with)
{
	struct mesh *m = with;
	bool seen;
	if (pm_operator_apply(&m->o, -1, (const double *[]){m->phi}, m->g, &seen))
		exit(1);
}

/* What the gradient reads and writes, without computing: by pieces, as it does. */
static void arrays_alone(void *with)
{
	enum { PIECE = 1536 };
	const struct mesh *m = with;
	const size_t n = pm_grid_size(&m->o.grid);
#pragma omp parallel for schedule(static)
	for (size_t p = 0; p < n; p += PIECE) {
		for (int d = 0; d < 3; d++)
			for (size_t i = p; i < p + PIECE; i += BANDWIDTH_LANES)
				bandwidth_past(m->g[d] + i, bandwidth_at(m->phi + i));
		bandwidth_fence();
	}
}

static void energy(void *with)
{
	struct mesh *m = with;
	if (!isfinite(pm_energy_on_mesh(&m->o.grid, m->rho, m->phi)))
		exit(1);
}

static struct mesh mesh_new(void)
{
	struct mesh m = {0};
	struct pm_grid g = {.dim = 3, .cells = {CELLS, CELLS, CELLS}, .points = {CELLS, CELLS, CELLS}, .h = {1, 1, 1}};
	for (int d = 0; d < 3; d++) {
		g.face[d][0] = g.face[d][1] = PM_PERIODIC;
		m.g[d] = pm_zalloc(pm_grid_size(&g), sizeof(double));
	}
	m.phi = pm_zalloc(pm_grid_size(&g), sizeof(double)), m.rho = pm_zalloc(pm_grid_size(&g), sizeof(double));
	for (size_t i = 0; i < pm_grid_size(&g); i++)
		m.phi[i] = (double)(i % 17) - 8, m.rho[i] = (double)(i % 13);
	if (pm_operator_init(&m.o, &g, PM_OP_GRAD, 2, 1, false))
		exit(1);
	return m;
}

static void measure(struct mesh m[2], struct bandwidth_arrays w[2])
{
	struct bench_job jobs[] = {{bandwidth_pass, &w[0], {0}}, {bandwidth_pass, &w[1], {0}}, {gradient, &m[0], {0}}, {gradient, &m[1], {0}},
		{energy, &m[0], {0}}, {arrays_alone, &m[0], {0}}};
	const double points = (double)pm_grid_size(&m[0].o.grid);
	bench_turns(6, jobs);
	bandwidth_row("mgrad", "its arrays read and written alone", 32, 0, points, &jobs[5], &w[0], &jobs[0]);
	bandwidth_row("mgrad", "order 2", 32, 6, points, &jobs[2], &w[0], &jobs[0]);
	bandwidth_row("mgrad", "order 4", 32, 15, points, &jobs[3], &w[0], &jobs[0]);
	bandwidth_row("diag", "field energy", 16, 9, points, &jobs[4], &w[1], &jobs[1]);
}

int main(void)
{
	struct mesh m[2] = {mesh_new()};
	struct bandwidth_arrays w[2] = {bandwidth_new(8 << 20)};
	int most = pm_threads();
	m[1] = m[0];
	if (pm_operator_init(&m[1].o, &m[0].o.grid, PM_OP_GRAD, 4, 1, false))
		return 1;
	w[1] = w[0];
	w[0].way = BANDWIDTH_COPY_NT, w[1].way = BANDWIDTH_READ;
	pm_threads_use(1);
	measure(m, w);
	if (most > 1) {
		pm_threads_use(most);
		measure(m, w);
	}
	return 0;
}
