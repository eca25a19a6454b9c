/* Speed of spread and gather, million particles per second: every kernel, random and tile-ordered positions, one scalar and (gather) a vector.
 * transfer [cells per axis [particles per cell [dim [kernel]]]]; the threads are OMP_NUM_THREADS. One thread is timed by the processor's clock, so that
 * other programs matter less, several by the wall's. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "mesh/transfer_order.h"

enum { repeats = 3 };

struct run {
	struct pm_transfer t;
	size_t n;
	double *x[3], *q, *mesh[3], *out[3];
};

/* Position p: anywhere, or in the order of tiles of 32x16x8 (64x64, 4096) cells. */
static void place(struct run *r, bool ordered, size_t per_cell)
{
	int dim = r->t.grid.dim;
	size_t cells = r->t.grid.cells[0], n = r->n, volume = per_cell, edge[3];
	for (int d = 0; d < dim; d++) {
		edge[d] = (size_t)1 << pm_tile_shift[dim][d];
		edge[d] = edge[d] < cells ? edge[d] : cells;
		volume *= edge[d];
	}
#pragma omp parallel for
	for (size_t p = 0; p < n; p++) {
		size_t tile = p / volume;
		for (int d = 0; d < dim; d++) {
			double u[2];
			pm_random(1, p, (uint64_t)d, u);
			r->x[d][p] = ordered ? (double)(tile % (cells / edge[d]) * edge[d]) + u[0] * (double)edge[d] : u[0] * (double)cells;
			tile /= cells / edge[d];
		}
		r->q[p] = 1;
	}
}

static double seconds(void)
{
	struct timespec t;
	if (pm_threads() > 1)
		return pm_seconds();
	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double rate(struct run *r, const struct pm_kernel *k, int gathered)
{
	double best = INFINITY;
	struct pm_strays strays;
	r->t.kernel = k;
	r->t.components = gathered ? gathered : 1;
	for (int i = 0; i < repeats; i++) {
		double began = seconds();
		int status = gathered ? pm_gather(&r->t, r->n, (const double *const *)r->x, (const double *const *)r->mesh, NULL, r->out, &strays)
				      : pm_spread(&r->t, r->n, (const double *const *)r->x, (const double *const *)&r->q, r->mesh, &strays);
		double took = seconds() - began;
		if (status)
			exit(1);
		best = took < best ? took : best;
	}
	return 1e-6 * (double)r->n / best;
}

int main(int argc, char **argv)
{
	size_t cells = argc > 1 ? strtoul(argv[1], NULL, 10) : 128, per_cell = argc > 2 ? strtoul(argv[2], NULL, 10) : 1;
	int dim = argc > 3 ? atoi(argv[3]) : 3;
	struct run r = {.t.grid = {.dim = dim}, .n = per_cell};
	for (int d = 0; d < 3; d++) {
		r.t.grid.cells[d] = r.t.grid.points[d] = d < dim ? cells : 1;
		r.t.grid.h[d] = 1;
		r.n *= d < dim ? cells : 1;
	}
	r.q = pm_zalloc(r.n, sizeof(double));
	for (int d = 0; d < 3; d++) {
		r.x[d] = pm_zalloc(r.n, sizeof(double));
		r.out[d] = pm_zalloc(r.n, sizeof(double));
		r.mesh[d] = pm_zalloc(pm_grid_size(&r.t.grid), sizeof(double));
	}
	printf("%d-D, %zu cells per axis, %zu particles, %d threads; million particles per second\n", dim, cells, r.n, pm_threads());
	printf("kernel\torder\tspread\tgather\tgather %d components\n", dim);
	for (int i = 0; pm_kernels[i]; i++)
		for (int ordered = 0; ordered < 2 && (argc < 5 || !strcmp(argv[4], pm_kernels[i]->name)); ordered++) {
			place(&r, ordered, per_cell);
			double spread = rate(&r, pm_kernels[i], 0), gather = rate(&r, pm_kernels[i], 1), vector = rate(&r, pm_kernels[i], dim);
			printf("%s\t%s\t%.1f\t%.1f\t%.1f\n", pm_kernels[i]->name, ordered ? "tiles" : "random", spread, gather, vector);
			fflush(stdout);
		}
	return 0;
}
