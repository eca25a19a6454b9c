/* Spread and gather: adjoint at every face rule, total strength, special positions, the tiled loops against the plain ones, any number of threads.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "mesh/transfer.h"

enum { MOST = 3 }; /* components */

struct problem {
	struct pm_transfer t;
	size_t n, points;
	double *x[3], *q[MOST], *mesh[MOST], *out[MOST];
};

static const enum pm_face faces[][2] = {{PM_PERIODIC, PM_PERIODIC}, {PM_WALL, PM_WALL}, {PM_NEUMANN, PM_NEUMANN}, {PM_OPEN, PM_OPEN},
	{PM_ABSORBING, PM_ABSORBING}, {PM_WALL, PM_NEUMANN}, {PM_OPEN, PM_WALL}, {PM_NEUMANN, PM_OPEN}};
static const char *const rule_names[] = {"periodic", "wall", "neumann", "open"};
enum { FACES = sizeof faces / sizeof *faces };

/* Awkward geometry: lo -0.3 - d/10, spacing 0.7, 0.55, 0.9. */
static struct pm_grid grid_of(int dim, const size_t cells[3], const int rule[3])
{
	struct pm_grid g = {.dim = dim};
	for (int d = 0; d < 3; d++) {
		bool used = d < dim;
		g.cells[d] = used ? cells[d] : 1;
		g.lo[d] = used ? -0.3 - d / 10. : 0;
		g.h[d] = used ? (const double[]){0.7, 0.55, 0.9}[d] : 1;
		for (int side = 0; side < 2; side++)
			g.face[d][side] = used ? faces[rule[d]][side] : PM_PERIODIC;
		g.points[d] = used && rule[d] ? g.cells[d] + 1 : g.cells[d];
	}
	return g;
}

static bool is_open(enum pm_face face) { return face == PM_OPEN || face == PM_ABSORBING; }

/* A position in [0,n] cells: random, and every eighth on a special place: a node, a half node, a face, an ulp beside one. */
static double place(const struct pm_transfer *t, int d, uint64_t p, double low, double high)
{
	double u[2];
	pm_random(7, p, (uint64_t)d, u);
	double s = low + u[0] * (high - low);
	if (p % 8 == 0)
		s = floor(s) + (p % 16 ? 0.5 : 0);
	if (p % 32 == 1)
		s = u[1] < 0.5 ? low : high;
	if (p % 32 == 17)
		s = u[1] < 0.5 ? nextafter(low, high) : nextafter(high, low);
	s = fmin(fmax(s, low), high);
	return t->grid.lo[d] + s * t->grid.h[d];
}

static void place_all(struct problem *a)
{
	for (int d = 0; d < a->t.grid.dim; d++) {
		const struct pm_grid *g = &a->t.grid;
		double r = 0.5 * a->t.kernel->width + 1e-9, n = (double)g->cells[d];
		double low = is_open(g->face[d][0]) ? r : 0, high = is_open(g->face[d][1]) ? n - r : n;
		if (g->face[d][0] == PM_PERIODIC)
			low = -0.4 * n, high = 1.4 * n; /* outside too: they fold */
		for (size_t p = 0; p < a->n; p++)
			a->x[d][p] = place(&a->t, d, p, low, high);
	}
}

static struct problem problem_new(struct pm_grid g, const struct pm_kernel *k, int components, size_t n)
{
	struct problem a = {.t = {.grid = g, .kernel = k, .components = components}, .n = n, .points = pm_grid_size(&g)};
	for (int c = 0; c < MOST; c++) {
		a.x[c] = pm_zalloc(n + 1, sizeof(double));
		a.q[c] = pm_zalloc(n + 1, sizeof(double));
		a.out[c] = pm_zalloc(n + 1, sizeof(double));
		a.mesh[c] = pm_zalloc(a.points, sizeof(double));
		for (size_t p = 0; p < n; p++) {
			double u[2];
			pm_random(8, p, (uint64_t)c, u);
			a.q[c][p] = 2 * u[0] - 0.7;
		}
	}
	place_all(&a);
	return a;
}

static void problem_free(struct problem *a)
{
	for (int c = 0; c < MOST; c++) {
		pm_free(a->x[c]);
		pm_free(a->q[c]);
		pm_free(a->out[c]);
		pm_free(a->mesh[c]);
	}
}

static const double *const *in(double *const *rows) { return (const double *const *)rows; }

/* Random mesh values; the padding of half offsets stays zero. */
static void fill_mesh(const struct problem *a, int c, double *mesh)
{
	const struct pm_grid *g = &a->t.grid;
	for (size_t i = 0; i < a->points; i++) {
		const size_t at[3] = {i % g->points[0], i / g->points[0] % g->points[1], i / g->points[0] / g->points[1]};
		double u[2];
		pm_random(9, i, (uint64_t)c, u);
		mesh[i] = u[0] - 0.5;
		for (int d = 0; d < g->dim; d++)
			if (a->t.half[c][d] && g->face[d][0] != PM_PERIODIC && at[d] == g->cells[d])
				mesh[i] = 0;
	}
}

/* The weight in mesh sums: half at end nodes, but a half offset has no end nodes. */
static double weight(const struct problem *a, int c, size_t i)
{
	const struct pm_grid *g = &a->t.grid;
	size_t at[3] = {i % g->points[0], i / g->points[0] % g->points[1], i / g->points[0] / g->points[1]};
	for (int d = 0; d < g->dim; d++)
		if (a->t.half[c][d])
			at[d] = 1;
	for (int d = 0; d < g->dim; d++)
		if (a->t.half[c][d] && g->cells[d] == 1)
			return NAN; /* not used */
	return pm_grid_weight(g, at[0], at[1], at[2]);
}

/* |<spread q, U> - <q, gather U>| over the sum of the absolute terms. */
static double adjoint_error(struct problem *a)
{
	struct pm_strays strays;
	double worst = 0, cell = pm_grid_cell(&a->t.grid);
	double *field[MOST] = {0};
	for (int c = 0; c < a->t.components; c++)
		fill_mesh(a, c, field[c] = pm_alloc(a->points, sizeof(double)));
	if (pm_spread(&a->t, a->n, in(a->x), in(a->q), a->mesh, &strays) || strays.count ||
		pm_gather(&a->t, a->n, in(a->x), in(field), NULL, a->out, &strays) || strays.count)
		worst = INFINITY;
	for (int c = 0; c < a->t.components; c++) {
		double on_mesh = 0, on_particles = 0, size = 0;
		for (size_t i = 0; i < a->points; i++)
			on_mesh += weight(a, c, i) * cell * a->mesh[c][i] * field[c][i];
		for (size_t p = 0; p < a->n; p++) {
			on_particles += a->q[c][p] * a->out[c][p];
			size += fabs(a->q[c][p] * a->out[c][p]);
		}
		worst = fmax(worst, fabs(on_mesh - on_particles) / size);
		pm_free(field[c]);
	}
	return worst;
}

/* Every kernel at every face rule, scalars and vectors with flipped images and half offsets. The rules of the axes are rotated so that mixtures
 * occur. 1e-13: sums of a few hundred terms, each with some ten roundings. */
static void check_adjoint(int dim, const size_t cells[3])
{
	for (int k = 0; pm_kernels[k]; k++)
		for (int rule = 0; rule < FACES; rule++)
			for (int vector = 0; vector < 3; vector++) {
				const int rules[3] = {rule, (rule + vector) % FACES, (rule + 2 * vector) % FACES};
				struct problem a = problem_new(grid_of(dim, cells, rules), pm_kernels[k], vector ? dim : 1, 300);
				for (int c = 0; c < a.t.components && vector; c++) {
					a.t.flip[c][c] = 1;
					a.t.half[c][(c + 1) % dim] = vector == 2;
				}
				double error = adjoint_error(&a);
				if (!(error <= 1e-13))
					check(false, "%s, %d-D, face rules %d %d %d, kind %d: spread and gather are adjoint (got %.3g, tolerance 1e-13)",
						pm_kernels[k]->name, dim, rules[0], rules[1], rules[2], vector, error);
				problem_free(&a);
			}
	check(true, "%d-D, %zux%zux%zu: spread and gather of every kernel were compared at every face rule", dim, cells[0], cells[1], cells[2]);
}

/* Total strength with half weights: exact at periodic, neumann and open faces; moments where nothing is near a face. */
static void check_total(int dim, const size_t cells[3], int rule)
{
	for (int k = 0; pm_kernels[k]; k++) {
		const int rules[3] = {rule, rule, rule};
		struct problem a = problem_new(grid_of(dim, cells, rules), pm_kernels[k], 1, 500);
		struct pm_strays strays;
		double total = 0, want = 0, size = 0;
		pm_spread(&a.t, a.n, in(a.x), in(a.q), a.mesh, &strays);
		for (size_t i = 0; i < a.points; i++)
			total += weight(&a, 0, i) * a.mesh[0][i] * pm_grid_cell(&a.t.grid);
		for (size_t p = 0; p < a.n; p++) {
			want += a.q[0][p];
			size += fabs(a.q[0][p]);
		}
		check(fabs(total - want) <= 1e-14 * size, "%s, %d-D, %s faces: the mesh sum is the total strength (off by %.2g of %.3g)",
			a.t.kernel->name, dim, rule_names[rule], fabs(total - want), size);
		problem_free(&a);
	}
}

int main(void)
{
	check_adjoint(1, (const size_t[]){13, 1, 1});
	check_adjoint(2, (const size_t[]){9, 14, 1});
	check_adjoint(3, (const size_t[]){9, 8, 11});
	for (int rule = 0; rule < 4; rule++)
		if (rule != 1)
			for (int dim = 1; dim <= 3; dim++)
				check_total(dim, (const size_t[]){11, 8, 9}, rule);
	return check_done();
}
