/* Spread and gather: adjoint at every face rule, total strength, special positions, the tiled loops against the plain ones, any number of threads.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "transfer/order-cache.h"

enum { MOST = 6 }; /* components */

struct problem {
	struct pm_transfer t;
	size_t n, points;
	double *x[MOST], *q[MOST], *mesh[MOST], *out[MOST];
};

static const enum pm_face faces[][2] = {{PM_PERIODIC, PM_PERIODIC}, {PM_WALL, PM_WALL}, {PM_NEUMANN, PM_NEUMANN}, {PM_OPEN, PM_OPEN},
	{PM_ABSORBING, PM_ABSORBING}, {PM_WALL, PM_NEUMANN}, {PM_OPEN, PM_WALL}, {PM_NEUMANN, PM_OPEN}, {PM_NEUMANN, PM_WALL}};
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

/* A position in [0,n] cells: random, and every eighth on a special place: a node, a half node, a face, one ulp away from one. */
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
			if (a->t.staggered[c][d] && g->face[d][0] != PM_PERIODIC && at[d] == g->cells[d])
				mesh[i] = 0;
	}
}

/* The weight in mesh sums: half at end nodes, but a half offset has no end nodes. */
static double weight(const struct problem *a, int c, size_t i)
{
	const struct pm_grid *g = &a->t.grid;
	size_t at[3] = {i % g->points[0], i / g->points[0] % g->points[1], i / g->points[0] / g->points[1]};
	for (int d = 0; d < g->dim; d++)
		if (a->t.staggered[c][d])
			at[d] = 1;
	for (int d = 0; d < g->dim; d++)
		if (a->t.staggered[c][d] && g->cells[d] == 1)
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
		check_worst(&worst, fabs(on_mesh - on_particles) / size);
		pm_free(field[c]);
	}
	return worst;
}

/* Every kernel at every face rule, scalars and vectors with flipped images and half offsets. The rules of the axes are rotated so that mixtures
 * occur. 1e-13: sums of a few hundred terms, each with some ten roundings. */
static void check_adjoint(int dim, const size_t cells[3])
{
	for (int k = 0; pm_kernels[k]; k++) {
		double worst = 0;
		int at[4] = {0}, cases = 0;
		for (int rule = 0; rule < FACES; rule++)
			for (int vector = 0; vector < 3; vector++, cases++) {
				const int rules[3] = {rule, (rule + vector) % FACES, (rule + 2 * vector) % FACES};
				struct problem a = problem_new(grid_of(dim, cells, rules), pm_kernels[k], vector ? dim : 1, 300);
				for (int c = 0; c < a.t.components && vector; c++) {
					a.t.flip[c][c] = 1;
					a.t.staggered[c][(c + 1) % dim] = vector == 2;
				}
				double error = adjoint_error(&a);
				if (check_worst(&worst, error))
					memcpy(at, (const int[]){rules[0], rules[1], rules[2], vector}, sizeof at);
				problem_free(&a);
			}
		check(worst <= 1e-13, "%s, %d-D: spread and gather are adjoint at every face rule (%d cases; worst %.2g at faces %d %d %d kind %d)",
			pm_kernels[k]->name, dim, cases, worst, at[0], at[1], at[2], at[3]);
	}
}

/* Total strength with half weights: exact at periodic, neumann and open faces; moments if no particle is near a face. */
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

/* The greatest difference of two arrays over the greatest value. */
static double difference(size_t n, const double *a, const double *b)
{
	double most = 0, size = 0;
	for (size_t i = 0; i < n; i++) {
		check_worst(&most, fabs(a[i] - b[i]));
		check_worst(&size, fabs(b[i]));
	}
	return size > 0 ? most / size : most;
}

/* Tiles against plain loops; meshes of several tiles that end in the middle of one. 1e-13: the order of some hundred terms per point. */
static void check_plain(int dim, const size_t cells[3], size_t many)
{
	double worst[2] = {0};
	for (int k = 0; pm_kernels[k]; k++)
		for (int rule = 0; rule < FACES; rule++) {
			if (check_sanitized() && rule != k % FACES)
				continue;
			const size_t n = check_sanitized() && dim == 3 && pm_kernels[k]->width > 4 ? many / 8 + 1 : many;
			const int rules[3] = {rule, (rule + 1) % FACES, (rule + 3) % FACES};
			struct problem a = problem_new(grid_of(dim, cells, rules), pm_kernels[k], dim, n), b = problem_new(a.t.grid, a.t.kernel, dim, n);
			struct pm_strays strays;
			const double *const factor[MOST] = {a.q[0], NULL, a.q[1]};
			for (int c = 1; c < dim; c++)
				a.t.staggered[c][0] = b.t.staggered[c][0] = a.t.flip[c][c] = b.t.flip[c][c] = 1;
			pm_spread(&a.t, n, in(a.x), in(a.q), a.mesh, &strays);
			pm_spread_plain(&b.t, n, in(b.x), in(b.q), b.mesh, &strays);
			for (int c = 0; c < dim; c++)
				check_worst(&worst[0], difference(a.points, a.mesh[c], b.mesh[c]));
			pm_gather(&a.t, n, in(a.x), in(b.mesh), factor, a.out, &strays);
			pm_gather_plain(&a.t, n, in(a.x), in(b.mesh), factor, b.out, &strays);
			for (int c = 0; c < dim; c++)
				check_worst(&worst[1], difference(n, a.out[c], b.out[c]));
			problem_free(&a);
			problem_free(&b);
		}
	check(worst[0] <= 1e-13, "%d-D: spreading by tiles is the plain loop (off by %.2g, tolerance 1e-13)", dim, worst[0]);
	check(worst[1] <= 1e-13, "%d-D: gathering by tiles is the plain loop (off by %.2g, tolerance 1e-13)", dim, worst[1]);
}

static uint64_t tile_of(const struct pm_axis axes[3], int dim, const double *const x[], size_t p)
{
	uint64_t tile = 0;
	double u;
	for (int d = dim - 1; d >= 0; d--) {
		pm_axis_locate(&axes[d], x[d][p], &u);
		tile = tile * axes[d].count + ((uint64_t)u >> pm_tile_shift[dim][d]);
	}
	return tile;
}

static struct problem *sorted;
static struct pm_axis sorted_axes[3];
static int by_tile(const void *a, const void *b)
{
	size_t p = *(const size_t *)a, q = *(const size_t *)b;
	uint64_t u = tile_of(sorted_axes, sorted->t.grid.dim, in(sorted->x), p), v = tile_of(sorted_axes, sorted->t.grid.dim, in(sorted->x), q);
	return u < v ? -1 : u > v ? 1 : p < q ? -1 : 1;
}

/* The particles of a, sorted in the order of tiles, in which they are not moved again. */
static void put_in_order(struct problem *a)
{
	size_t *at = pm_alloc(a->n, sizeof *at);
	double *copy = pm_alloc(a->n, sizeof *copy);
	for (size_t p = 0; p < a->n; p++)
		at[p] = p;
	sorted = a;
	pm_axes_init(sorted_axes, &a->t, a->t.staggered[0]);
	qsort(at, a->n, sizeof *at, by_tile);
	for (int d = 0; d < a->t.grid.dim; d++) {
		memcpy(copy, a->x[d], a->n * sizeof *copy);
		for (size_t p = 0; p < a->n; p++)
			a->x[d][p] = copy[at[p]];
	}
	pm_axes_free(sorted_axes);
	pm_free(at);
	pm_free(copy);
}

/* In order: nothing is moved; the sums are those of the plain loop for 1 to 3 threads. Values are set, then added. */
static void check_in_order(int dim, const size_t cells[3], size_t n, const char *kernel, const int rules[3])
{
	struct problem a = problem_new(grid_of(dim, cells, rules), pm_kernel_find(kernel), dim, n), b;
	struct pm_strays strays;
	struct pm_axis axes[3];
	struct pm_tile_order order;
	int threads = pm_threads();
	double worst = 0;
	put_in_order(&a);
	b = problem_new(a.t.grid, a.t.kernel, dim, n);
	for (int d = 0; d < dim; d++)
		memcpy(b.x[d], a.x[d], n * sizeof(double));
	pm_axes_init(axes, &a.t, a.t.staggered[0]);
	struct pm_column x[3];
	pm_columns_of(dim, in(a.x), x);
	pm_tile_order_init(&order, axes, &(struct pm_tile_particles){.dim = dim, .n = n, .x = x}, dim, &strays);
	check(!order.records && order.tiles > 1, "%d-D: a stream in the order of %zu tiles is not moved", dim, order.tiles);
	pm_tile_order_free(&order);
	pm_axes_free(axes);
	pm_spread_plain(&b.t, n, in(b.x), in(b.q), b.mesh, &strays);
	pm_gather_plain(&b.t, n, in(b.x), in(b.mesh), NULL, b.out, &strays);
	for (int count = 1; count <= 3; count++) {
		pm_threads_use(count);
		for (int c = 0; c < dim; c++) {
			memset(a.mesh[c], 0, a.points * sizeof(double));
			memset(a.out[c], 255, n * sizeof(double));
			a.t.set[c] = true;
		}
		pm_spread(&a.t, n, in(a.x), in(a.q), a.mesh, &strays);
		strays.finite = false;
		pm_gather(&a.t, n, in(a.x), in(b.mesh), NULL, a.out, &strays);
		for (int c = 0; c < dim; c++)
			check_worst(&worst, difference(a.points, a.mesh[c], b.mesh[c])), check_worst(&worst, difference(n, a.out[c], b.out[c]));
		check(strays.finite, "%d-D: values that are set and finite are marked as finite", dim);
	}
	a.t.set[0] = false;
	pm_gather(&a.t, n, in(a.x), in(b.mesh), NULL, a.out, &strays);
	check(fabs(a.out[0][n / 2] - 2 * b.out[0][n / 2]) <= 1e-13 * fabs(b.out[0][n / 2]), "%d-D: values are added where they are not set", dim);
	for (size_t i = 0; i < 100; i++)
		b.mesh[0][b.points / 2 + i] = INFINITY;
	pm_gather(&a.t, n, in(a.x), in(b.mesh), NULL, a.out, &strays);
	check(!strays.finite, "%d-D: an infinite value is detected", dim);
	check(worst <= 1e-13, "%d-D, %s: spread and gather in order are the plain loops with 1, 2 and 3 threads (off by %.2g, tolerance 1e-13)", dim, kernel,
		worst);
	pm_threads_use(threads);
	problem_free(&a);
	problem_free(&b);
}

/* Nearly in order, with a stray: particles stay where they are in the stream. The sums of the plain loop with 1 to 3 threads; a value has the bytes that its
 * particle gets in a stream in order. */
static void check_nearly(int dim, const size_t cells[3], size_t n, const char *kernel)
{
	enum { apart = 97 };
	struct problem a = problem_new(grid_of(dim, cells, (const int[]){3, 0, 2}), pm_kernel_find(kernel), dim, n), b;
	struct pm_strays strays;
	const int threads = pm_threads();
	double worst = 0;
	bool same = true, stay = true;
	put_in_order(&a);
	b = problem_new(a.t.grid, a.t.kernel, dim, n);
	for (int d = 0; d < dim; d++)
		memcpy(b.x[d], a.x[d], n * sizeof(double));
	for (int c = 0; c < dim; c++)
		fill_mesh(&a, c, b.mesh[c]), a.t.set[c] = b.t.set[c] = true;
	pm_gather(&b.t, n, in(b.x), in(b.mesh), NULL, b.out, &strays);
	for (int d = 0; d < dim; d++)
		for (size_t p = 0; p < n / 2; p += apart) {
			const double here = a.x[d][p];
			a.x[d][p] = a.x[d][n - 1 - p], a.x[d][n - 1 - p] = here;
		}
	a.x[0][n / 3] = a.t.grid.lo[0] - 9 * a.t.grid.h[0];
	for (int count = 1; count <= 3; count++) {
		struct pm_note *note = NULL;
		struct pm_column x[3];
		pm_threads_use(count);
		a.t.kept = &note;
		for (int c = 0; c < dim; c++) {
			memset(a.mesh[c], 0, a.points * sizeof(double));
			memset(a.out[c], 255, n * sizeof(double));
		}
		pm_spread(&a.t, n, in(a.x), in(a.q), a.mesh, &strays);
		pm_columns_of(dim, in(a.x), x);
		stay = stay && ((struct pm_order_cache *)note)->order.runs.run && strays.count == 1 && strays.first == n / 3;
		pm_gather(&a.t, n, in(a.x), in(b.mesh), NULL, a.out, &strays);
		stay = stay && strays.finite && strays.count == 1;
		for (int c = 0; c < dim; c++)
			for (size_t p = 0; p < n; p++) {
				const size_t twin = p < n / 2 && p % apart == 0 ? n - 1 - p : n - 1 - p < n / 2 && (n - 1 - p) % apart == 0 ? n - 1 - p : p;
				same = same && a.out[c][p] == (p == n / 3 ? 0 : b.out[c][twin]);
			}
		note->free(note);
		struct problem plain = problem_new(a.t.grid, a.t.kernel, dim, n);
		pm_spread_plain(&plain.t, n, in(a.x), in(a.q), plain.mesh, &strays);
		for (int c = 0; c < dim; c++)
			check_worst(&worst, difference(a.points, a.mesh[c], plain.mesh[c]));
		problem_free(&plain);
	}
	check(stay, "%d-D, %s: particles nearly in the order of tiles stay in the stream, and a stray is counted", dim, kernel);
	check(same, "%d-D, %s: each of them gathers the bytes that it gets in order, the stray 0", dim, kernel);
	check(worst <= 1e-13, "%d-D, %s: spread nearly in order is the plain loop with 1, 2 and 3 threads (off by %.2g, tolerance 1e-13)", dim, kernel, worst);
	pm_threads_use(threads);
	problem_free(&a);
	problem_free(&b);
}

/* Particles of a lattice that a smooth flow has moved, a cell one after the other in most rows: straight from the stream, by their places, and in records.
 * The bytes of particles taken one by one, since behind each there is one without strength two cells on. */
static void check_neighbours(int dim, const size_t cells[3], const char *kernel)
{
	enum { together = 5 };
	const struct pm_grid g = grid_of(dim, cells, (const int[]){0, 0, 0});
	const size_t n = pm_grid_size(&g);
	bool spreads = true, gathers = true;
	for (int way = 0; way < 3; way++) {
		struct problem a = problem_new(g, pm_kernel_find(kernel), dim, n), b = problem_new(g, a.t.kernel, dim, 2 * n);
		struct pm_strays strays;
		for (size_t k = 0; k < n; k++) { /* last: pieces of the two halves in turn */
			const size_t half = n / 2, i = k / together, p = way < 2 || k >= half / together * together * 2 ? k
													   : i / 2 * together + k % together + i % 2 * half;
			const size_t at[3] = {p % cells[0], p / cells[0] % cells[1], p / cells[0] / cells[1]};
			const double phase = 0.17 * (double)at[0] + 0.3 * (double)at[1] + 0.2 * (double)at[2];
			for (int d = 0; d < dim; d++)
				a.x[d][k] = g.lo[d] + ((double)at[d] + 0.9 * sin(phase + d)) * g.h[d];
		}
		if (!way)
			put_in_order(&a);
		for (int d = 0; d < dim; d++) {
			fill_mesh(&a, d, a.mesh[d]);
			a.t.set[d] = b.t.set[d] = true;
			for (size_t k = 0; k < n; k++) {
				b.x[d][2 * k] = a.x[d][k], b.x[d][2 * k + 1] = a.x[d][k] + (d ? 0 : 2 * g.h[0]);
				b.q[d][2 * k] = a.q[d][k], b.q[d][2 * k + 1] = 0;
			}
		}
		pm_gather(&a.t, n, in(a.x), in(a.mesh), NULL, a.out, &strays);
		pm_gather(&b.t, 2 * n, in(b.x), in(a.mesh), NULL, b.out, &strays);
		for (int d = 0; d < dim; d++) {
			for (size_t k = 0; k < n; k++)
				gathers = gathers && a.out[d][k] == b.out[d][2 * k];
			memset(a.mesh[d], 0, a.points * sizeof(double));
		}
		pm_spread(&a.t, n, in(a.x), in(a.q), a.mesh, &strays);
		pm_spread(&b.t, 2 * n, in(b.x), in(b.q), b.mesh, &strays);
		for (int d = 0; d < dim; d++)
			spreads = spreads && !memcmp(a.mesh[d], b.mesh[d], a.points * sizeof(double));
		problem_free(&a);
		problem_free(&b);
	}
	check(spreads, "%d-D, %s: particles in neighbouring cells spread the bytes that they spread one by one", dim, kernel);
	check(gathers, "%d-D, %s: particles in neighbouring cells gather the bytes that they gather one by one", dim, kernel);
}

/* Several components at once, in order and from any order: the bytes of one after the other. */
static void check_components(const size_t cells[3], size_t n, const char *kernel, int components)
{
	for (int ordered = 0; ordered < 2; ordered++) {
		struct problem a = problem_new(grid_of(3, cells, (const int[]){0, 0, 0}), pm_kernel_find(kernel), components, n);
		struct pm_strays strays;
		double *mesh[PM_COMPONENTS], *out[PM_COMPONENTS], *one = pm_alloc(n, sizeof *one);
		bool same = true;
		if (ordered)
			put_in_order(&a);
		for (int c = 0; c < components; c++) {
			mesh[c] = pm_alloc(a.points, sizeof(double)), out[c] = pm_alloc(n, sizeof(double));
			for (size_t i = 0; i < a.points; i++)
				mesh[c][i] = sin((double)i + 0.7 * c);
			a.t.set[c] = true;
		}
		pm_gather(&a.t, n, in(a.x), in(mesh), NULL, out, &strays);
		a.t.components = 1;
		for (int c = 0; c < components; c++) {
			pm_gather(&a.t, n, in(a.x), in(&mesh[c]), NULL, &one, &strays);
			same = same && !memcmp(one, out[c], n * sizeof *one);
			pm_free(mesh[c]), pm_free(out[c]);
		}
		check(same, "%s, %d components%s have the bytes of one after the other", kernel, components, ordered ? " in order" : "");
		pm_free(one);
		problem_free(&a);
	}
}

/* One number for all strengths or factors: the bytes of an array of them, in order and from any order. */
static void check_one_number(int dim, const size_t cells[3], size_t n, const char *kernel)
{
	for (int sorted_first = 0; sorted_first < 2; sorted_first++) {
		struct problem a = problem_new(grid_of(dim, cells, (const int[]){0, 0, 0}), pm_kernel_find(kernel), dim, n);
		struct pm_strays strays;
		struct pm_column x[3], q[MOST], factor[MOST];
		struct pm_target out[MOST];
		double *mesh[MOST], *array[MOST];
		bool same = true;
		if (sorted_first)
			put_in_order(&a);
		pm_columns_of(dim, in(a.x), x);
		for (int c = 0; c < dim; c++) {
			const double number = 0.37 - 1.1 * c;
			q[c] = factor[c] = (struct pm_column){.value = number};
			array[c] = pm_alloc(n, sizeof(double));
			for (size_t p = 0; p < n; p++)
				array[c][p] = number;
			out[c] = (struct pm_target){.doubles = a.out[c]};
			mesh[c] = pm_zalloc(a.points, sizeof(double));
		}
		pm_spread_columns(&a.t, n, x, q, a.mesh, &strays);
		pm_spread(&a.t, n, in(a.x), in(array), mesh, &strays);
		for (int c = 0; c < dim; c++)
			same = same && !memcmp(mesh[c], a.mesh[c], a.points * sizeof(double));
		check(same, "%d-D, %s: one strength for all is spread as an array of them", dim, kernel);
		same = true;
		for (int add = 0; add < 2; add++) {
			for (int c = 0; c < dim; c++)
				fill_mesh(&a, c, a.mesh[c]), memcpy(a.q[c], a.out[c], n * sizeof(double)), a.t.set[c] = !add;
			pm_gather_columns(&a.t, n, x, in(a.mesh), factor, out, &strays);
			pm_gather(&a.t, n, in(a.x), in(a.mesh), in(array), a.q, &strays);
			for (int c = 0; c < dim; c++)
				same = same && !memcmp(a.q[c], a.out[c], n * sizeof(double));
		}
		check(same, "%d-D, %s: one factor for all is that of an array of them", dim, kernel);
		for (int c = 0; c < dim; c++)
			pm_free(mesh[c]), pm_free(array[c]);
		problem_free(&a);
	}
}

/* Positions that are floats: the bytes of doubles with their values; what is gathered to floats is that, rounded. */
static void check_floats(int dim, const size_t cells[3], size_t n)
{
	struct problem a = problem_new(grid_of(dim, cells, (const int[]){0, 0, 0}), pm_kernel_find("cic"), 1, n);
	struct pm_strays strays;
	struct pm_column x[3], q[1] = {pm_column_doubles(a.q[0])}, factor[1] = {{.value = 0.37}};
	float *at = pm_alloc(n * (size_t)dim, sizeof *at), *out = pm_zalloc(n, sizeof *out);
	double *times = pm_alloc(n, sizeof *times);
	bool same = true;
	put_in_order(&a);
	for (int d = 0; d < dim; d++)
		for (size_t p = 0; p < n; p++)
			at[(size_t)d * n + p] = (float)a.x[d][p], a.x[d][p] = at[(size_t)d * n + p], times[p] = 0.37;
	for (int d = 0; d < dim; d++)
		x[d] = (struct pm_column){.floats = at + (size_t)d * n};
	pm_spread_columns(&a.t, n, x, q, a.mesh, &strays);
	pm_spread(&a.t, n, in(a.x), in(a.q), a.mesh + 1, &strays);
	same = !memcmp(a.mesh[0], a.mesh[1], a.points * sizeof(double));
	check(same, "%d-D: positions that are floats are spread as doubles with their values", dim);
	a.t.set[0] = true;
	pm_gather_columns(&a.t, n, x, in(a.mesh), factor, &(struct pm_target){.floats = out}, &strays);
	pm_gather(&a.t, n, in(a.x), in(a.mesh), (const double *const[]){times}, a.out, &strays);
	for (size_t p = 0; p < n; p++)
		same = same && out[p] == (float)a.out[0][p];
	check(same, "%d-D: what is gathered to floats is what doubles get, rounded", dim);
	pm_free(at), pm_free(out), pm_free(times);
	problem_free(&a);
}

/* The second half of the stream is one tile before the first half: the only fall is between two batches, and with two threads between their chunks. */
static void check_fall(void)
{
	const size_t n = 16384;
	struct problem a = problem_new(grid_of(1, (const size_t[]){9001, 1, 1}, (const int[]){0, 0, 0}), pm_kernel_find("cic"), 1, n), b;
	struct pm_strays strays;
	const int threads = pm_threads();
	double worst = 0;
	for (size_t p = 0; p < n; p++)
		a.x[0][p] = a.t.grid.lo[0] + a.t.grid.h[0] * ((p < n / 2 ? 5000.1 : 10.1) + 1e-3 * (double)p);
	for (int count = 1; count <= 2; count++) {
		b = problem_new(a.t.grid, a.t.kernel, 1, n);
		pm_threads_use(count);
		memset(a.mesh[0], 0, a.points * sizeof(double));
		pm_spread(&a.t, n, in(a.x), in(a.q), a.mesh, &strays);
		pm_spread_plain(&b.t, n, in(a.x), in(a.q), b.mesh, &strays);
		check_worst(&worst, difference(a.points, a.mesh[0], b.mesh[0]));
		problem_free(&b);
	}
	check(worst <= 1e-13, "a stream whose second half lies before its first is put in order (off by %.2g, tolerance 1e-13)", worst);
	pm_threads_use(threads);
	problem_free(&a);
}

/* A gather that reuses the order of a spread gives the same bytes as one that sorts itself, also a second time; for other positions or another width the
 * order is not reused. */
static void check_kept(int dim, const size_t cells[3], const char *other)
{
	const int rules[3] = {0, 2, 0};
	const size_t n = 20000; /* sorted in two parts where there are two threads */
	struct problem a = problem_new(grid_of(dim, cells, rules), pm_kernel_find("cic"), dim, n), b = problem_new(a.t.grid, a.t.kernel, dim, n);
	struct pm_strays strays;
	struct pm_note *note = NULL;
	bool same = true;
	for (int c = 0; c < dim; c++)
		a.t.set[c] = b.t.set[c] = true;
	a.t.kept = &note;
	double worst = 0;
	pm_spread(&a.t, n, in(a.x), in(a.q), a.mesh, &strays);
	pm_spread_plain(&b.t, n, in(a.x), in(a.q), b.mesh, &strays);
	for (int c = 0; c < dim; c++)
		check_worst(&worst, difference(a.points, a.mesh[c], b.mesh[c]));
	check(worst <= 1e-13, "%d-D: %d components are spread as by the plain loop (off by %.2g, tolerance 1e-13)", dim, dim, worst);
	const struct pm_note *left = note;
	for (int c = 0; c < dim; c++)
		for (size_t i = 0; i < a.points; i++)
			a.mesh[c][i] = sin((double)(i + (size_t)c));
	pm_gather(&b.t, n, in(a.x), in(a.mesh), NULL, b.out, &strays);
	for (int twice = 0; twice < 2; twice++) {
		pm_gather(&a.t, n, in(a.x), in(a.mesh), NULL, a.out, &strays);
		for (int c = 0; c < dim; c++)
			same = same && !memcmp(a.out[c], b.out[c], n * sizeof(double));
	}
	struct pm_column here[3], there[3];
	pm_columns_of(dim, in(a.x), here), pm_columns_of(dim, in(b.x), there);
	const struct pm_order_cache *kept = pm_order_cache_find(&a.t, a.t.staggered[0], n, here);
	check(left && note == left && kept && same, "%d-D: a gather uses the order a spread has left, and gives equal bytes", dim);
	check(kept && pm_tile_order_spent(&kept->order), "%d-D: its results took the place of the records, which are given back", dim);
	check(!pm_order_cache_find(&a.t, a.t.staggered[0], n, there), "%d-D: it is not that of other positions", dim);
	a.t.kernel = pm_kernel_find(other);
	check(!pm_order_cache_find(&a.t, a.t.staggered[0], n, here), "%d-D: nor that of kernel %s", dim, other);
	note->free(note);
	problem_free(&a);
	problem_free(&b);
}

/* Threads 1, 2, 3; a third of the particles are in one tile, so that it is divided among threads. */
static void check_threads(int dim, const size_t cells[3], const char *kernel)
{
	const int rules[3] = {0, 2, 0};
	const size_t n = 60000;
	struct problem a = problem_new(grid_of(dim, cells, rules), pm_kernel_find(kernel), dim, n);
	struct pm_strays strays;
	double *mesh = pm_alloc(a.points, sizeof *mesh), *out = pm_alloc(n, sizeof *out);
	int threads = pm_threads();
	bool same = true;
	for (size_t p = 0; p < n; p += 3)
		for (int d = 0; d < dim; d++)
			a.x[d][p] = a.t.grid.lo[d] + a.t.grid.h[d] * (3 + 2e-5 * (double)p);
	for (int k = 0; k < 4; k++) { /* 64: more than there are jobs */
		const int count = (const int[]){1, 2, 3, 64}[k];
		pm_threads_use(count);
		for (int c = 0; c < dim; c++) {
			memset(a.mesh[c], 0, a.points * sizeof *mesh);
			memset(a.out[c], 0, n * sizeof *out);
		}
		pm_spread(&a.t, n, in(a.x), in(a.q), a.mesh, &strays);
		pm_gather(&a.t, n, in(a.x), in(a.mesh), NULL, a.out, &strays);
		if (count == 1) {
			memcpy(mesh, a.mesh[dim - 1], a.points * sizeof *mesh);
			memcpy(out, a.out[dim - 1], n * sizeof *out);
		}
		same = same && !memcmp(mesh, a.mesh[dim - 1], a.points * sizeof *mesh) && !memcmp(out, a.out[dim - 1], n * sizeof *out);
	}
	check(same, "%d-D, %s: 1, 2, 3 and 64 threads give equal bytes, crowded tile included", dim, kernel);
	pm_threads_use(threads);
	pm_free(mesh);
	pm_free(out);
	problem_free(&a);
}

/* Explicit images: a mesh with walls is half of a periodic mesh of twice the length that holds the mirrored particles as well. */
static void check_images(int rule, double sign)
{
	for (int k = 0; pm_kernels[k]; k++) {
		enum { cells = 12, n = 40 };
		struct problem a = problem_new(grid_of(1, (const size_t[]){cells, 1, 1}, (const int[]){rule, 0, 0}), pm_kernels[k], 1, n);
		struct problem b = problem_new(grid_of(1, (const size_t[]){2 * cells, 1, 1}, (const int[]){0, 0, 0}), pm_kernels[k], 1, 2 * n);
		struct pm_strays strays;
		double lo = a.t.grid.lo[0], worst = 0;
		for (int p = 0; p < n; p++) { /* not on half nodes, where ngp goes up in the original and down in the image */
			double u[2];
			pm_random(5, (uint64_t)p, 0, u);
			a.x[0][p] = b.x[0][p] = lo + a.t.grid.h[0] * (p < 2 ? p * cells : u[0] * cells);
			b.x[0][n + p] = 2 * lo - a.x[0][p];
			b.q[0][p] = a.q[0][p];
			b.q[0][n + p] = sign * a.q[0][p];
		}
		pm_spread(&a.t, n, in(a.x), in(a.q), a.mesh, &strays);
		pm_spread(&b.t, 2 * n, in(b.x), in(b.q), b.mesh, &strays);
		for (int i = 0; i <= cells; i++)
			check_worst(&worst, fabs(a.mesh[0][i] - b.mesh[0][i]));
		check(worst <= 1e-13, "%s at a %s face: the image has %s sign (off by %.2g, tolerance 1e-13)", pm_kernels[k]->name, rule_names[rule],
			sign > 0 ? "the same" : "the opposite", worst);
		if (sign < 0)
			check(a.mesh[0][0] == 0 && a.mesh[0][cells] == 0, "%s: the density on a wall is 0", pm_kernels[k]->name);
		problem_free(&a);
		problem_free(&b);
	}
}

/* W at distance s [cells] from a particle. */
static double kernel_at(const struct pm_kernel *k, double s)
{
	double low = k->width % 2 ? -0.5 : 0, base = floor(-s - low), w[PM_KERNEL_WIDTH]; /* the particle at -s, the point at 0 */
	int i = (int)(-base) + (k->width - 1) / 2;
	pm_kernel_weights(k, -s - base, w);
	return i < 0 || i >= k->width ? 0 : w[i];
}

static double value_at(const struct pm_kernel *k, bool near, double s) { return near ? floor(0.5 - s) == 0 : kernel_at(k, s); }

/* A product, or a star: the sum over the axes of its weights there times the nearest points along the others, less what is counted dim - 1 times. */
static double combined(const struct pm_kernel *k, int dim, const double own[3], const double near[3])
{
	double product = 1, nearest = 1, sum = 0;
	for (int d = 0; d < dim; d++) {
		double term = own[d];
		for (int e = 0; e < dim; e++)
			term *= e == d ? 1 : near[e];
		sum += term, product *= own[d], nearest *= near[d];
	}
	return k->star ? sum - (dim - 1) * nearest : product;
}

/* One axis by formula: n cells from 0 on, points at i or i + 1/2; a particle at s, its periodic images or its mirror images made by reflecting it at one face
 * after the other, each time with the sign of that face. */
struct formula {
	const struct pm_kernel *kernel;
	bool near;        /* the nearest point instead (of a star) */
	double n, offset; /* [cells] */
	bool periodic;
	int sign[2]; /* of the image in the face: 1, -1; 0: none */
};

static struct formula formula_of(const struct problem *a, int c, int d)
{
	const struct pm_grid *g = &a->t.grid;
	struct formula f = {.kernel = a->t.kernel, .n = (double)g->cells[d], .offset = a->t.staggered[c][d] ? 0.5 : 0,
		.periodic = g->face[d][0] == PM_PERIODIC};
	for (int side = 0; side < 2; side++) {
		f.sign[side] = g->face[d][side] == PM_WALL ? -1 : g->face[d][side] == PM_NEUMANN ? 1 : 0;
		f.sign[side] *= a->t.flip[c][d] ? -1 : 1;
	}
	return f;
}

/* The contribution of a particle of strength 1 to point i. */
static double received(const struct formula *f, double s, size_t i)
{
	double at = (double)i + f->offset, sum = value_at(f->kernel, f->near, at - s);
	for (int k = 1; k <= 8 && f->periodic; k++)
		sum += value_at(f->kernel, f->near, at - s - k * f->n) + value_at(f->kernel, f->near, at - s + k * f->n);
	for (int first = 0; first < 2 && !f->periodic; first++) { /* the face that reflects first */
		double image = s, strength = 1;
		for (int k = 0; k < 8; k++) {
			int side = (first + k) % 2;
			image = side ? 2 * f->n - image : -image, strength *= f->sign[side];
			sum += strength * value_at(f->kernel, f->near, at - image);
		}
	}
	return sum;
}

/* A function with the symmetries of the faces, on the whole axis. */
static double symmetric(const struct formula *f, double s)
{
	if (f->periodic)
		return cos(2 * pm_pi * s / f->n + 0.4) + 0.3;
	if (!f->sign[0] && !f->sign[1])
		return cos(0.7 * s + 0.4);
	if (!f->sign[0])
		return f->sign[1] > 0 ? cos(0.7 * (s - f->n)) : sin(0.7 * (s - f->n));
	double k = f->sign[1] ? pm_pi * (f->sign[0] == f->sign[1] ? 2 : 1.5) / f->n : 0.7;
	return f->sign[0] > 0 ? cos(k * s) : sin(k * s);
}

/* The value that a particle gathers from it: a sum over a row of points without faces. */
static double gathered(const struct formula *f, double s)
{
	double sum = 0;
	for (double i = floor(s) - 6; i <= floor(s) + 6; i++)
		sum += value_at(f->kernel, f->near, i + f->offset - s) * symmetric(f, i + f->offset);
	return sum;
}

static void by_formula(struct problem *a, int c, double worst[2])
{
	const struct pm_grid *g = &a->t.grid;
	double most = 0, far[2] = {0}, *want = pm_zalloc(a->points, sizeof *want), *field = pm_zalloc(a->points, sizeof *field);
	double *share[2][3]; /* of the particles, by points of each axis: the kernel, the nearest point */
	struct formula f[2][3];
	struct pm_strays strays;
	for (int d = 0; d < g->dim; d++) {
		for (int b = 0; b < 2; b++) {
			f[b][d] = formula_of(a, c, d);
			f[b][d].near = b;
			share[b][d] = pm_alloc(g->points[d] * a->n, sizeof ***share);
			for (size_t i = 0; i < g->points[d]; i++)
				for (size_t p = 0; p < a->n; p++)
					share[b][d][i * a->n + p] = received(&f[b][d], (a->x[d][p] - g->lo[d]) / g->h[d], i);
		}
	}
	for (size_t i = 0; i < a->points; i++) {
		const size_t at[3] = {i % g->points[0], i / g->points[0] % g->points[1], i / g->points[0] / g->points[1]};
		bool used = true; /* the last point of a staggered axis is not */
		field[i] = 1;
		for (int d = 0; d < g->dim; d++)
			used = used && (f[0][d].periodic || !f[0][d].offset || at[d] < g->cells[d]),
				field[i] *= symmetric(&f[0][d], (double)at[d] + f[0][d].offset);
		field[i] *= used;
		for (size_t p = 0; p < a->n && used; p++) {
			double part[2][3];
			for (int d = 0; d < 2 * g->dim; d++)
				part[d % 2][d / 2] = share[d % 2][d / 2][at[d / 2] * a->n + p];
			want[i] += a->q[c][p] / pm_grid_cell(g) * combined(a->t.kernel, g->dim, part[0], part[1]);
		}
	}
	const double *fields[MOST] = {field, field, field};
	if (pm_spread(&a->t, a->n, in(a->x), in(a->q), a->mesh, &strays) || strays.count || pm_gather(&a->t, a->n, in(a->x), fields, NULL, a->out, &strays) ||
		strays.count)
		worst[0] = NAN;
	for (size_t i = 0; i < a->points; i++)
		check_worst(&far[0], fabs(a->mesh[c][i] - want[i])), check_worst(&most, fabs(want[i]));
	check_worst(&worst[0], far[0] / most);
	for (size_t p = 0; p < a->n; p++) {
		double part[2][3];
		for (int d = 0; d < 2 * g->dim; d++)
			part[d % 2][d / 2] = gathered(&f[d % 2][d / 2], (a->x[d / 2][p] - g->lo[d / 2]) / g->h[d / 2]);
		check_worst(&worst[1], fabs(a->out[c][p] - combined(a->t.kernel, g->dim, part[0], part[1])));
	}
	for (int d = 0; d < 2 * g->dim; d++)
		pm_free(share[d % 2][d / 2]);
	pm_free(want), pm_free(field);
}

/* Spread and gather against that formula, which does not use the folding of indices at faces: every kernel, every pair of faces, points on nodes and half a
 * cell up, both signs, axes shorter than the kernel too. 2e-13: sums of some ten products of size 1, densities over one cell. */
static void check_formula(int dim, const size_t cells[3], size_t n)
{
	for (int k = 0; pm_kernels[k]; k++) {
		double worst[2] = {0};
		for (int q = 0; q < FACES * 4; q++) {
			const int rules[3] = {q / 4, (q / 4 + 1) % FACES, (q / 4 + 4) % FACES};
			struct pm_grid g = grid_of(dim, cells, rules);
			bool room = true;
			for (int d = 0; d < dim; d++)
				room = room && (g.cells[d] > PM_KERNEL_WIDTH || (!is_open(g.face[d][0]) && !is_open(g.face[d][1])));
			if (!room)
				continue;
			struct problem a = problem_new(g, pm_kernels[k], 1, n);
			for (int d = 0; d < dim; d++) {
				a.t.staggered[0][d] = (unsigned char)(d ? !(q & 1) : q & 1), a.t.flip[0][d] = (unsigned char)(q >> 1 & 1);
				for (size_t p = 0; p < n; p++) { /* not beside a tie of ngp */
					double r = is_open(g.face[d][0]) || is_open(g.face[d][1]) ? 0.5 * a.t.kernel->width : 0, u[2];
					pm_random(11, p, (uint64_t)d, u);
					a.x[d][p] = g.lo[d] + g.h[d] * (r + u[0] * ((double)g.cells[d] - 2 * r));
				}
			}
			by_formula(&a, 0, worst);
			problem_free(&a);
		}
		check(worst[0] <= 2e-13, "%s, %d-D, %zu cells: densities are sums over reflected particles at every pair of faces, on nodes and half nodes "
			"(off by %.2g)", pm_kernels[k]->name, dim, cells[0], worst[0]);
		check(worst[1] <= 2e-13, "%s, %d-D, %zu cells: and gathered values are sums over the function continued beyond the faces (off by %.2g)",
			pm_kernels[k]->name, dim, cells[0], worst[1]);
	}
}

/* Three jobs of 16384 particles and five more in one tile, in the order of the tiles and not. */
static void check_crowd(int dim, const char *kernel, bool in_order)
{
	const size_t n = 3 * 16384 + 5;
	struct problem a = problem_new(grid_of(dim, (const size_t[]){40, 36, 20}, (const int[]){0, 0, 0}), pm_kernel_find(kernel), 1, n);
	struct problem b = problem_new(a.t.grid, a.t.kernel, 1, n);
	struct pm_strays strays;
	for (size_t p = 0; p < n; p++)
		for (int d = 0; d < dim; d++) {
			double u[2];
			pm_random(12, p, (uint64_t)d, u);
			a.x[d][p] = b.x[d][p] = a.t.grid.lo[d] + a.t.grid.h[d] * (p == 1 && !in_order ? 30 : 1 + u[0]);
			a.q[0][p] = b.q[0][p] = 1;
		}
	int bad = pm_spread(&a.t, n, in(a.x), in(a.q), a.mesh, &strays) | pm_spread_plain(&b.t, n, in(b.x), in(b.q), b.mesh, &strays);
	double total = 0, off = difference(a.points, a.mesh[0], b.mesh[0]);
	for (size_t i = 0; i < a.points; i++)
		total += a.mesh[0][i] * pm_grid_cell(&a.t.grid);
	/* 1e-10: 5e4 roundings of 1e-16 that may add up, times ten; a particle is 2e-5 of the sum */
	check(!bad && off <= 1e-10 && fabs(total - (double)n) <= 1e-10 * (double)n, "%s, %d-D: %zu particles in one tile%s are all spread (sum off by %.2g)",
		kernel, dim, n, in_order ? ", in order," : "", total - (double)n);
	a.t.set[0] = true;
	for (size_t p = 0; p < n; p++)
		a.out[0][p] = NAN;
	bad = pm_gather(&a.t, n, in(a.x), in(b.mesh), NULL, a.out, &strays) | pm_gather_plain(&b.t, n, in(b.x), in(b.mesh), NULL, b.out, &strays);
	off = difference(n, a.out[0], b.out[0]);
	check(!bad && off <= 1e-13, "%s, %d-D: and each of them gathers its value (off by %.2g)", kernel, dim, off);
	problem_free(&a);
	problem_free(&b);
}

/* FP-04, HC-59: positions that a cast or x - L floor(x/L) would put out of range. */
static void check_edges(void)
{
	const double length = 7 * 0.7, lo = -0.3;
	const double places[] = {lo, lo + length, nextafter(lo, -1), nextafter(lo + length, -1), nextafter(lo + length, 9), lo - 1e-17, -1e-17, 1e300, -1e300,
		DBL_MAX, -DBL_MAX, DBL_MIN, lo - length, lo + 1e9 * length};
	enum { n = sizeof places / sizeof *places };
	for (int k = 0; pm_kernels[k]; k++) {
		struct problem a = problem_new(grid_of(3, (const size_t[]){7, 7, 7}, (const int[]){0, 0, 0}), pm_kernels[k], 1, n);
		struct pm_strays strays;
		double total = 0, want = 0;
		for (int p = 0; p < n; p++) {
			a.x[0][p] = places[p];
			a.x[1][p] = places[(p + 3) % n];
			a.x[2][p] = places[(p + 5) % n];
			want += a.q[0][p];
		}
		pm_spread(&a.t, n, in(a.x), in(a.q), a.mesh, &strays);
		for (size_t i = 0; i < a.points; i++)
			total += a.mesh[0][i] * pm_grid_cell(&a.t.grid);
		check(strays.count == 0 && fabs(total - want) <= 1e-13, "HC-59, FP-04: %s finds a place for x = -1e-17, L, L - ulp, 1e300 (off by %.2g)",
			a.t.kernel->name, fabs(total - want));
		problem_free(&a);
	}
	struct problem a = problem_new(grid_of(1, (const size_t[]){7, 1, 1}, (const int[]){0, 0, 0}), pm_kernel_find("cic"), 1, 1);
	struct problem b = problem_new(a.t.grid, a.t.kernel, 1, 1);
	struct pm_strays strays;
	a.x[0][0] = lo;
	b.x[0][0] = lo + length;
	pm_spread(&a.t, 1, in(a.x), in(a.q), a.mesh, &strays);
	pm_spread(&b.t, 1, in(b.x), in(b.q), b.mesh, &strays);
	check(difference(a.points, a.mesh[0], b.mesh[0]) <= 1e-14, "FP-04: lo + L is lo");
	b.x[0][0] = NAN;
	pm_spread(&b.t, 1, in(b.x), in(b.q), b.mesh, &strays);
	check(strays.count == 1, "a position that is no number is a stray, not an index");
	problem_free(&a);
	problem_free(&b);
}

/* At open faces the support stays inside the points 1..n-1; at the others a particle may sit on the face. */
static void check_open(void)
{
	for (int k = 0; pm_kernels[k]; k++) {
		const struct pm_kernel *kernel = pm_kernels[k];
		enum { cells = 11 };
		struct problem a = problem_new(grid_of(1, (const size_t[]){cells, 1, 1}, (const int[]){3, 0, 0}), kernel, 1, 3);
		struct pm_strays strays;
		double lo = 0, r = 0.5 * kernel->width, sum = 0;
		a.t.grid.lo[0] = lo; /* so that the limits are exact */
		a.t.grid.h[0] = 1;
		a.x[0][0] = r;
		a.x[0][1] = nextafter(cells - r, 0);
		a.x[0][2] = cells / 2.;
		pm_spread(&a.t, 3, in(a.x), in(a.q), a.mesh, &strays);
		for (int i = 1; i < cells; i++)
			sum += a.mesh[0][i];
		check(strays.count == 0 && a.mesh[0][0] == 0 && a.mesh[0][cells] == 0 && fabs(sum - a.q[0][0] - a.q[0][1] - a.q[0][2]) <= 1e-14,
			"%s: particles may come within %g cells of an open face, and the end nodes stay 0", kernel->name, r);
		a.x[0][1] = nextafter(r, 0);
		a.x[0][2] = nextafter(cells - r + 1e-15, 99);
		pm_spread(&a.t, 3, in(a.x), in(a.q), a.mesh, &strays);
		check(strays.count == 2 && strays.first == 1 && strays.x[0] == a.x[0][1] && strays.axis == 0,
			"%s: a particle nearer than that is a stray, counted, and the first is reported", kernel->name);
		size_t below[3], above[3];
		a.x[0][1] = -4.25;
		a.x[0][2] = cells + 0.5;
		int status = pm_transfer_grow(&a.t, 3, in(a.x), below, above);
		a.t.grid.cells[0] += below[0] + above[0];
		a.t.grid.points[0] = a.t.grid.cells[0] + 1;
		a.t.grid.lo[0] -= (double)below[0];
		pm_gather(&a.t, 0, in(a.x), in(a.mesh), NULL, a.out, &strays);
		double *bigger = pm_zalloc(a.t.grid.points[0], sizeof *bigger);
		pm_spread(&a.t, 3, in(a.x), in(a.q), &bigger, &strays);
		check(!status && strays.count == 0 && (double)below[0] <= 6 + r && (double)above[0] <= 4 + r,
			"%s: the mesh grows by %zu and %zu cells and holds all", kernel->name, below[0], above[0]);
		pm_free(bigger);
		problem_free(&a);
	}
}

static void check_few(void)
{
	struct problem a = problem_new(grid_of(2, (const size_t[]){5, 4, 1}, (const int[]){0, 2, 0}), pm_kernel_find("pcs"), 1, 1);
	struct pm_strays strays;
	a.mesh[0][3] = 5;
	check(!pm_spread(&a.t, 0, in(a.x), in(a.q), a.mesh, &strays) && a.mesh[0][3] == 5 && !strays.count, "no particles add nothing");
	check(!pm_gather(&a.t, 0, in(a.x), in(a.mesh), NULL, a.out, &strays), "no particles gather nothing");
	double before = 0, after = 0;
	for (size_t i = 0; i < a.points; i++)
		before += weight(&a, 0, i) * a.mesh[0][i];
	pm_spread(&a.t, 1, in(a.x), in(a.q), a.mesh, &strays);
	for (size_t i = 0; i < a.points; i++)
		after += weight(&a, 0, i) * a.mesh[0][i];
	check_near((after - before) * pm_grid_cell(&a.t.grid), a.q[0][0], 1e-14, "one particle adds its strength to the mesh");
	problem_free(&a);
}

/* A field of low degree is gathered exactly, as follows from the kernel's moments. */
static void check_exact(void)
{
	for (int k = 0; pm_kernels[k]; k++) {
		struct problem a = problem_new(grid_of(3, (const size_t[]){12, 14, 13}, (const int[]){3, 3, 3}), pm_kernels[k], 1, 200);
		const struct pm_grid *g = &a.t.grid;
		struct pm_strays strays;
		double worst = 0;
		for (size_t i = 0; i < a.points; i++) {
			double x = (double)(i % g->points[0]), y = (double)(i / g->points[0] % g->points[1]), z = (double)(i / g->points[0] / g->points[1]);
			a.mesh[0][i] = 1 + (a.t.kernel->moments > 0 ? x - 2 * y + (a.t.kernel->star ? z : z * x) : 0) +
				(a.t.kernel->moments > 1 ? x * x - y * y * (a.t.kernel->star ? 3 : z) : 0);
		}
		pm_gather(&a.t, a.n, in(a.x), in(a.mesh), NULL, a.out, &strays);
		for (size_t p = 0; p < a.n; p++) {
			double s[3];
			for (int d = 0; d < 3; d++)
				s[d] = (a.x[d][p] - g->lo[d]) / g->h[d];
			double want = 1 + (a.t.kernel->moments > 0 ? s[0] - 2 * s[1] + s[2] * (a.t.kernel->star ? 1 : s[0]) : 0) +
				      (a.t.kernel->moments > 1 ? s[0] * s[0] - s[1] * s[1] * (a.t.kernel->star ? 3 : s[2]) : 0);
			check_worst(&worst, fabs(a.out[0][p] - want));
		}
		check(worst <= 1e-11, "%s gathers polynomials of degree %d per axis exactly (off by %.2g of 1000)", a.t.kernel->name, a.t.kernel->moments,
			worst);
		problem_free(&a);
	}
}

/* E and B on Yee's mesh at once, where a tile has enough particles for nodes, against each component alone: particles in any order, in the order of tiles, and
 * nearly so. `lower`: with the kernel one order lower along the axes on which a component sits half a cell up, against the plain loop too. */
static void check_yee(int dim, const size_t cells[3], size_t n, const char *kernel, const int rules[3], bool lower)
{
	struct problem a = problem_new(grid_of(dim, cells, rules), pm_kernel_find(kernel), 6, n);
	const double *const factor[MOST] = {NULL, a.q[0], NULL, a.q[1], NULL, NULL};
	double *alone = pm_zalloc(n + 1, sizeof *alone);
	struct pm_strays strays;
	double worst = 0;
	bool same = true;
	a.t.lower = lower ? pm_kernel_lower(a.t.kernel) : NULL;
	a.t.cut = lower;
	for (int c = 0; c < 6; c++)
		for (int d = 0; d < 3; d++)
			a.t.staggered[c][d] = d < dim && (c % 3 == d) == (c < 3), a.t.flip[c][d] = (c % 3 == d) != (c < 3);
	for (int c = 0; c < 6; c++)
		fill_mesh(&a, c, a.mesh[c]);
	for (int order = 0; order < 3; order++) {
		if (order == 1) { /* that of the nodes */
			a.t.staggered[0][0] = 0;
			put_in_order(&a);
			a.t.staggered[0][0] = 1;
		}
		for (size_t p = 0; order == 2 && p + 1000 < n; p += 100)
			for (int d = 0; d < dim; d++) {
				const double x = a.x[d][p];
				a.x[d][p] = a.x[d][p + 999], a.x[d][p + 999] = x;
			}
		for (int c = 0; c < 6; c++)
			memset(a.out[c], 0, n * sizeof *a.out[c]);
		pm_gather(&a.t, n, in(a.x), in(a.mesh), factor, a.out, &strays);
		for (int c = 0; c < 6; c++) {
			struct pm_transfer one = a.t;
			one.components = 1;
			memcpy(one.staggered[0], a.t.staggered[c], 3), memcpy(one.flip[0], a.t.flip[c], 3);
			memset(alone, 0, n * sizeof *alone);
			pm_gather(&one, n, in(a.x), in(a.mesh + c), factor + c, &alone, &strays);
			same = same && !memcmp(alone, a.out[c], n * sizeof *alone);
			memset(alone, 0, n * sizeof *alone);
			pm_gather_plain(&one, n, in(a.x), in(a.mesh + c), factor + c, &alone, &strays);
			for (size_t p = 0; p < n; p++)
				check_worst(&worst, fabs(alone[p] - a.out[c][p]));
		}
	}
	const char *how = lower ? ", with lower kernels," : "";
	check(same, "%d-D, %s, faces %d: E and B gathered at once%s by %zu particles are each component alone, to the last bit", dim, kernel, rules[0], how, n);
	check(worst <= 1e-15, "%d-D, %s, faces %d: and those of the plain loop%s (off by %.2g of 0.5)", dim, kernel, rules[0], how, worst);
	pm_free(alone);
	problem_free(&a);
}

int main(void)
{
	check_adjoint(1, (const size_t[]){13, 1, 1});
	check_adjoint(2, (const size_t[]){11, 14, 1});
	check_adjoint(3, (const size_t[]){11, 12, 13}); /* the widest kernel, 10 points, needs 11 cells between open faces */
	for (int rule = 0; rule < 4; rule++)
		if (rule != 1)
			for (int dim = 1; dim <= 3; dim++)
				check_total(dim, (const size_t[]){13, 12, 11}, rule);
	check_plain(1, (const size_t[]){5003, 1, 1}, 3000);
	check_plain(1, (const size_t[]){70, 1, 1}, 6001); /* one tile, and enough for pairs */
	check_plain(2, (const size_t[]){131, 70, 1}, 3000);
	check_plain(3, (const size_t[]){33, 18, 20}, 3000);
	check_plain(3, (const size_t[]){33, 17, 9}, 6000); /* as many particles as cells: corners */
	check_plain(3, (const size_t[]){3, 17, 2}, 100);
	check_threads(1, (const size_t[]){9001, 1, 1}, "tsc");
	check_in_order(1, (const size_t[]){9001, 1, 1}, 4000, "tsc", (const int[]){0, 0, 0});
	for (int rule = 0; rule < 4; rule++) /* enough for pairs */
		check_in_order(1, (const size_t[]){9001, 1, 1}, rule % 2 ? 20000 : 20003, "cic", (const int[]){rule, 0, 0});
	check_threads(1, (const size_t[]){9001, 1, 1}, "cic");
	check_fall();
	check_threads(2, (const size_t[]){130, 67, 1}, "tsc");
	check_in_order(2, (const size_t[]){130, 67, 1}, 4000, "tsc", (const int[]){0, 0, 0});
	for (int rule = 0; rule < 4; rule++) /* a whole and a broken number of eights */
		check_in_order(2, (const size_t[]){130, 67, 1}, rule % 2 ? 8000 : 8003, "cic", (const int[]){rule, rule ? rule % 3 + 1 : 0, 0});
	check_threads(2, (const size_t[]){130, 67, 1}, "cic");
	check_threads(3, (const size_t[]){35, 20, 33}, "tsc");
	check_in_order(3, (const size_t[]){35, 20, 33}, 8000, "tsc", (const int[]){0, 0, 0});
	for (int rule = 0; rule < 4; rule++) /* enough for squares, and a whole and a broken number of eights */
		check_in_order(3, (const size_t[]){35, 20, 33}, rule % 2 ? 30000 : 30003, "cic", (const int[]){rule, rule ? rule % 3 + 1 : 0, 0});
	check_in_order(3, (const size_t[]){7, 5, 9}, 4101, "cic", (const int[]){0, 2, 0});
	check_threads(3, (const size_t[]){35, 20, 33}, "cic");
	check_in_order(3, (const size_t[]){35, 20, 33}, 8001, "m6prime", (const int[]){0, 0, 0});
	for (int k = 0; k < 5; k++)
		check_components((const size_t[]){35, 20, 33}, 9001, (const char *const[]){"cic", "tsc", "pcs", "m6prime", "lambda-6-4"}[k],
			(const int[]){4, 3, 5, 6, 4}[k]);
	for (int k = 0; k < 5; k++) {
		const char *kernel = (const char *const[]){"tsc", "pcs", "m6prime", "lambda-6-4", "m4prime"}[k];
		check_neighbours(1, (const size_t[]){9001, 1, 1}, kernel);
		check_neighbours(2, (const size_t[]){130, 67, 1}, kernel);
		check_neighbours(3, (const size_t[]){35, 20, 17}, kernel);
	}
	check_nearly(1, (const size_t[]){9001, 1, 1}, 20003, "cic");
	check_nearly(2, (const size_t[]){130, 67, 1}, 9001, "tsc");
	check_nearly(2, (const size_t[]){130, 67, 1}, 9001, "cic");
	check_nearly(3, (const size_t[]){35, 20, 33}, 60003, "cic");
	check_nearly(3, (const size_t[]){35, 20, 33}, 30003, "pcs");
	check_one_number(1, (const size_t[]){9001, 1, 1}, 20003, "cic");
	check_floats(1, (const size_t[]){4000, 1, 1}, 20003); /* one tile, in whatever order */
	check_floats(2, (const size_t[]){130, 67, 1}, 8003);
	check_floats(3, (const size_t[]){35, 20, 33}, 30003);
	check_one_number(2, (const size_t[]){130, 67, 1}, 5001, "tsc");
	check_one_number(3, (const size_t[]){35, 20, 33}, 30003, "cic");
	check_kept(1, (const size_t[]){40961, 1, 1}, "tsc");
	check_kept(2, (const size_t[]){270, 131, 1}, "pcs");
	check_kept(3, (const size_t[]){35, 20, 33}, "tsc");
	check_formula(1, (const size_t[]){13, 1, 1}, 40);
	check_formula(1, (const size_t[]){2, 1, 1}, 20);
	check_formula(2, (const size_t[]){11, 12, 1}, 20);
	check_formula(3, (const size_t[]){11, 12, 13}, 4);
	for (int dim = 1; dim <= 3; dim++)
		check_crowd(dim, "cic", true), check_crowd(dim, "m4prime", false);
	for (int k = 0; k < 3; k++) { /* several tiles, and one */
		const char *kernel = (const char *[]){"cic", "tsc", "pcs"}[k];
		for (int lower = 0; lower < 2; lower++) {
			check_yee(3, (const size_t[]){33, 17, 9}, 30001, kernel, (const int[]){0, 0, 0}, lower);
			check_yee(3, (const size_t[]){13, 12, 7}, 16390, kernel, (const int[]){1, 2, 0}, lower);
			check_yee(2, (const size_t[]){70, 66, 1}, 16387, kernel, (const int[]){k % 2, 0, 0}, lower);
		}
		check_yee(3, (const size_t[]){13, 12, 7}, 16390, kernel, (const int[]){3, 2, 1}, true);
		check_yee(1, (const size_t[]){70, 1, 1}, 1001, kernel, (const int[]){k, 0, 0}, true);
	}
	check_images(1, -1);
	check_images(2, 1);
	check_edges();
	check_open();
	check_few();
	check_exact();
	return check_done();
}
