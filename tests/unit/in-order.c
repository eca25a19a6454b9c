/* The law of sums (docs/distributed.md): data cut into stretches at multiples of a block, or into planes, and joined in order give what the whole gives, to the
 * last bit; so do any number of threads; and no group of lines crosses a plane. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "base/in-order.h"
#include "far/pp.h"
#include "fft/line-groups.h"
#include "limit/rates.h"
#include "measure/growth.h"
#include "measure/measure.h"
#include "measure/norms.h"
#include "measure/range.h"
#include "mesh/gradient.h"
#include "mesh/laplacian.h"
#include "mesh/mesh-sum.h"
#include "remesh/remesh.h"
#include "stream/declare.h"
#include "stream/run.h"

enum { MOST = 70000 };
static double a[MOST], b[MOST], root[MOST], side[MOST];

/* Numbers a = side root^2 up to 1e34, of which the first n nearly cancel: so large and so many bits apart that compensated sums in different orders differ. */
static void fill(size_t n)
{
	const size_t pairs = n / 3;
	for (size_t i = 0; i < MOST; i++) {
		double u[2];
		const size_t k = i / 3, other = (k * 7919 + 13) % (pairs ? pairs : 1); /* 7919 is prime: every pair once */
		const bool big = i % 3 < 2 && i < 3 * pairs;
		pm_random(7, i % 3 == 1 && big ? 3 * other : i, 0, u);
		root[i] = big ? exp(40 * u[0]) : 0.5 + u[0];
		side[i] = i % 3 == 1 ? -1 : 1;
		a[i] = side[i] * (root[i] * root[i]);
		b[i] = 1 + u[1];
	}
}

static void make(const void *data, size_t from, size_t to, void *part)
{
	const double *x = data;
	for (size_t i = from; i < to; i++)
		pm_sum_add(part, x[i]);
}

static const struct pm_parts plain = {.size = sizeof(struct pm_sum), .make = make, .join = pm_join_sums};

/* The sum of n values by its definition, one block or row after the other. */
static double by_blocks(size_t n, size_t block, const double *x)
{
	struct pm_sum all = {0, 0};
	for (size_t from = 0; from < n; from += block) {
		struct pm_sum one = {0, 0};
		make(x, from, from + block < n ? from + block : n, &one);
		pm_sum_add(&all, one.sum), pm_sum_add(&all, one.carry);
	}
	return pm_sum_total(all);
}

static double by_planes(const size_t n[3], const double *x)
{
	struct pm_sum all = {0, 0};
	for (size_t k = 0; k < n[2]; k++) {
		struct pm_sum plane = {0, 0};
		for (size_t j = 0; j < n[1]; j++) {
			struct pm_sum row = {0, 0};
			make(x, (k * n[1] + j) * n[0], (k * n[1] + j + 1) * n[0], &row);
			pm_sum_add(&plane, row.sum), pm_sum_add(&plane, row.carry);
		}
		pm_sum_add(&all, plane.sum), pm_sum_add(&all, plane.carry);
	}
	return pm_sum_total(all);
}

static const size_t sizes[] = {0, 1, 4096, 4097, 8191, MOST};
enum { SIZES = sizeof sizes / sizeof *sizes };

/* Parts made in `ranks` stretches, joined in order. */
static struct pm_sum of_stretches(size_t n, size_t ranks)
{
	const size_t blocks = (n + pm_sum_block - 1) / pm_sum_block;
	struct pm_sum all = {0, 0}, part[MOST / pm_sum_block + 1];
	for (size_t r = 0; r < ranks; r++) {
		const size_t first = blocks * r / ranks, count = blocks * (r + 1) / ranks - first;
		double *mine = malloc((count * pm_sum_block + 1) * sizeof *mine); /* a rank has no more than this */
		memcpy(mine, a + first * pm_sum_block, (first + count < blocks ? count * pm_sum_block : n - first * pm_sum_block) * sizeof *mine);
		for (size_t i = 0; i < count; i++) {
			part[i] = (struct pm_sum){0, 0};
			const size_t at = (first + i) * pm_sum_block;
			make(mine, at - first * pm_sum_block, (at + pm_sum_block < n ? at + pm_sum_block : n) - first * pm_sum_block, &part[i]);
		}
		pm_join_parts(&plain, count, part, &all);
		free(mine);
	}
	return all;
}

static void stretches_of_sets(void)
{
	bool whole = true, cut = true, blocks = true;
	for (int k = 0; k < SIZES; k++) {
		struct pm_sum all = {0, 0}, apart;
		fill(sizes[k]);
		pm_over_set(&plain, a, sizes[k], &all);
		whole &= pm_sum_total(all) == by_blocks(sizes[k], pm_sum_block, a);
		for (size_t ranks = 1; ranks <= 7; ranks++) {
			apart = of_stretches(sizes[k], ranks);
			cut &= !memcmp(&apart, &all, sizeof all);
		}
		const size_t n = sizes[k], m = n / pm_sum_block / 2, count = (n + pm_sum_block - 1) / pm_sum_block;
		struct pm_sum part[MOST / pm_sum_block + 1], joined = {0, 0};
		pm_parts_of_blocks(&plain, a, n, pm_sum_block, 0, m, part);
		pm_join_parts(&plain, m, part, &joined);
		pm_parts_of_blocks(&plain, a, n, pm_sum_block, m, count - m, part);
		pm_join_parts(&plain, count - m, part, &joined);
		blocks &= !memcmp(&joined, &all, sizeof all);
	}
	check(whole, "a sum over a set is that of its blocks in order (0, 1, 4096, 4097, 8191, 70000 particles)");
	check(cut, "stretches of 1 to 7 ranks, joined, give sum and carry of the whole to the last bit");
	check(blocks, "and so do parts of the library made apart");
	check(by_blocks(MOST, pm_sum_block, a) != by_blocks(MOST, MOST, a), "which one running sum does not: the numbers tell");
}

static void planes_of_meshes(void)
{
	static const size_t mesh[][3] = {{1, 1, 1}, {997, 1, 1}, {17, 31, 1}, {257, 257, 1}, {15, 15, 15}, {41, 33, 47}, {7, 1, 9}};
	bool whole = true, cut = true;
	for (int k = 0; k < 7; k++) {
		const size_t *n = mesh[k], parts = n[2] > 1 ? n[2] : n[1];
		struct pm_sum all = {0, 0}, joined = {0, 0}, one, row = {0, 0};
		fill(n[0] * n[1] * n[2]);
		pm_over_mesh(&plain, a, n, &all);
		whole &= pm_sum_total(all) == by_planes(n, a);
		for (size_t p = 0; p < parts; p++) {
			pm_parts_of_mesh(&plain, a, n, p, 1, &one);
			pm_join_parts(&plain, 1, &one, n[2] > 1 ? &joined : &row);
		}
		if (n[2] <= 1)
			pm_join_sums(sizeof row, &row, &joined);
		cut &= !memcmp(&joined, &all, sizeof all);
	}
	check(whole, "a sum over a mesh is by row, then plane, then mesh (1-D to 3-D)");
	const size_t n[3] = {1, 23, 100};
	fill(2300);
	check(pm_sum_of_rows(n, a) == by_planes(n, a) && by_planes(n, a) != by_blocks(2300, pm_sum_block, a), "and so is one of numbers that rows have");
	check(cut, "planes made one at a time, or rows in 2-D, joined, give the whole to the last bit");
}

/* Means and norms of a field on a set or on a mesh of n points. */
static void fields(struct pm_frame *f, const char *on, const size_t *n)
{
	struct pm_field *q = pm_makes(f, on, "q", 1, PM_DERIVED), *zero = pm_makes(f, on, "zero", 1, PM_DERIVED);
	if (pm_field_ready(q) || pm_field_ready(zero))
		exit(1);
	fill(q->count);
	memcpy(pm_out(q, 0), a, q->count * sizeof *a);
	const double want = n ? by_planes(n, a) : by_blocks(q->count, pm_sum_block, a), running = by_blocks(q->count, q->count, a);
	const double weight = n ? by_planes(n, side) : by_blocks(q->count, pm_sum_block, side);
	check(want != running && pm_range_of(f, q, 0).mean == want / (double)q->count, "the mean of a field on a %s", n ? "mesh" : "set");
	check(pm_norms_of(f, q, zero, NULL, side).l1 == want / weight, "norms of a field on a %s", n ? "mesh" : "set");
}

/* Families that add over a set or a mesh, against the definition with the same terms. */
static void families(void)
{
	const size_t n[3] = {24, 19, 28}, size = 24 * 19 * 28;
	struct pm_frame *f = pm_frame_new(3);
	static double ones[MOST];
	double rows[19 * 28];
	for (int d = 0; d < 3; d++)
		f->face[d][0] = f->face[d][1] = PM_PERIODIC;
	const struct pm_grid g = pm_grid_of(f, pm_frame_mesh_new(f, "mesh", n));
	pm_frame_set_new(f, "matter", MOST);
	fields(f, "matter", NULL);
	fields(f, "mesh", n);
	for (size_t i = 0; i < MOST; i++)
		ones[i] = 1;
	fill(MOST);
	check(pm_charge_over_mass(MOST, root, side) == by_blocks(MOST, pm_sum_block, a), "the plasma frequency's sum");
	struct pm_shell *shell = malloc(MOST * sizeof *shell);
	for (size_t i = 0; i < MOST; i++)
		shell[i] = (struct pm_shell){.r = (double)i, .mass = i % 2 ? 1 : 3, .index = i};
	double radius, fraction = 1;
	pm_radii(MOST, shell, 1, &fraction, &radius);
	check_near(radius, MOST - 1, 0, "the radius of all mass");
	fill(size);
	const struct pm_laplacian l = pm_laplacian_of(&g);
	const double got = pm_laplacian_product(&l, a, ones, rows), want = by_planes((const size_t[3]){1, 19, 28}, rows);
	check(got == want, "the inner product of relaxation: rows, planes, mesh");
	struct pm_remesh r = pm_remesh_on(&g, pm_kernel_find("m4prime"));
	struct pm_sum all = {0, 0};
	r.node[0] = a, r.n = 1;
	pm_sum_of_mesh(n, a, NULL, NULL, &all);
	check(pm_remesh_total(&r, 0) == pm_sum_total(all) && pm_grid_sum(&g, a, ones) == pm_sum_total(all), "sums over the nodes of remesh, and of the energy");
	free(shell);
	pm_frame_free(f);
}

/* ---- threads ---- */

struct results {
	double of[16], g[3][2][4097]; /* sums; what pp gives */
};

static void compute(struct results *r)
{
	const size_t n[3] = {41, 33, 47};
	const struct pm_grid g = {.dim = 3, .cells = {41, 32, 46}, .points = {41, 33, 47}, .h = {1, 1, 1},
		.face = {{PM_PERIODIC, PM_PERIODIC}, {PM_NEUMANN, PM_NEUMANN}, {PM_NEUMANN, PM_NEUMANN}}};
	const double *x[3] = {b, b + 5000, b + 10000};
	const struct pm_measured m = {.n = MOST - 5000, .dim = 3, .vdim = 3, .x = {b, b, b + 5000}, .v = {a, a, b + 5000}, .mass = side};
	struct pm_particle_sums bulk = {0};
	struct pm_sum all = {0, 0};
	memset(r, 0, sizeof *r);
	r->of[0] = pm_sum_array(MOST, a), r->of[1] = pm_sum_products(MOST, a, b), r->of[2] = pm_energy_on_mesh(&g, a, b);
	pm_particle_sums_add(&m, &bulk);
	r->of[3] = bulk.kinetic, r->of[4] = bulk.angular[2], r->of[5] = bulk.farthest;
	r->of[6] = pm_charge_over_mass(MOST, root, side);
	if (pm_mode(&g, &(struct pm_field){0}, a, 3, &r->of[7]))
		r->of[7] = NAN;
	pm_sum_of_mesh(n, a, b, NULL, &all);
	r->of[9] = all.sum, r->of[10] = all.carry;
	for (int half = 0; half < 2; half++) {
		const size_t count[2] = {4096, 1};
		const struct pm_pp p = {.dim = 3, .delta = 0.1, .mollifier = pm_mollifier_find("plummer"), .half = half, .sets = 2, .count = count};
		double *const out[3] = {r->g[0][half], r->g[1][half], r->g[2][half]};
		uint64_t coincident;
		if (pm_pp_sum(&p, 4097, 4097, x, b, out, NULL, &coincident))
			out[0][0] = NAN;
	}
}

static void threads(void)
{
	static const int counts[] = {1, 2, 3, 7};
	fill(MOST);
	struct results *r = malloc(2 * sizeof *r);
	bool same = true;
	for (int k = 0; k < 4; k++) {
		pm_threads_use(counts[k]);
		compute(&r[k > 0]);
		same &= !memcmp(&r[0], &r[k > 0], sizeof *r) && r->of[0] != 0;
	}
	check(same, "1, 2, 3 and 7 threads: the same bytes of all these sums and of pp");
	free(r);
}

/* ---- pp ---- */

/* Bodies without strength in front of or behind a set change no byte of what its own do to each other: blocks are counted from the first of the set. */
static void sets_apart(void)
{
	enum { N = 3100, OTHER = 33 };
	static double x[3][N + OTHER], q[N + OTHER], alone[3][N], both[3][N + OTHER];
	bool same = true;
	for (size_t i = 0; i < N + OTHER; i++)
		for (int d = 0; d < 3; d++)
			x[d][i] = b[3 * i + (size_t)d], q[i] = i < OTHER ? 0 : 0.1 + b[i];
	const double *all[3] = {x[0], x[1], x[2]}, *mine[3] = {x[0] + OTHER, x[1] + OTHER, x[2] + OTHER};
	const size_t count[2] = {OTHER, N};
	struct pm_pp p = {.dim = 3, .delta = 0.1, .mollifier = pm_mollifier_find("plummer")};
	uint64_t coincident;
	int status = pm_pp_sum(&p, N, N, mine, q + OTHER, (double *const[]){alone[0], alone[1], alone[2]}, NULL, &coincident);
	p.sets = 2, p.count = count;
	status |= pm_pp_sum(&p, N + OTHER, N + OTHER, all, q, (double *const[]){both[0], both[1], both[2]}, NULL, &coincident);
	for (int d = 0; d < 3; d++)
		same &= !memcmp(alone[d], both[d] + OTHER, N * sizeof **alone);
	check(!status && same, "pp, each target over all: a set in front without strength changes no byte of another");
}

/* ---- groups of lines ---- */

static void groups(void)
{
	static const size_t mesh[][3] = {{15, 15, 15}, {33, 17, 5}, {16, 32, 3}, {40, 37, 1}, {100, 1, 1}};
	bool inside = true, once = true;
	for (int k = 0; k < 5; k++)
		for (int d = 0; d < 3; d++) {
			const size_t *n = mesh[k], size = n[0] * n[1] * n[2];
			unsigned char *seen = calloc(size, 1);
			for (size_t i = 0; i < pm_line_groups(n, d); i++) {
				const struct pm_line_group g = pm_line_group(n, d, i);
				for (size_t line = 0; line < g.lines; line++)
					for (size_t node = 0; node < n[d]; node++) {
						const size_t at = g.at + line * g.across + node * g.step;
						once &= at < size && !seen[at]++;
						inside &= d == 2 || at / (n[0] * n[1]) == g.at / (n[0] * n[1]);
						inside &= d < 2 || at / n[0] % n[1] == g.at / n[0] % n[1];
					}
			}
			for (size_t i = 0; i < size; i++)
				once &= seen[i] == 1;
			free(seen);
		}
	check(once, "groups of lines cover every node once, along every axis");
	check(inside, "no group crosses a plane, and none along z a row of pencils");
}

/* d/dx and d/dy of a field that is changed in plane 5. */
static void planes_apart(void)
{
	for (int walls = 0; walls < 2; walls++) {
		const size_t points = walls ? 16 : 15, plane = points * points, size = plane * points;
		struct pm_grid g = {.dim = 3};
		struct pm_operator o;
		struct pm_fft_plans plans = {0};
		double *phi = malloc(size * sizeof *phi), *out[2] = {NULL, NULL};
		bool same = true, seen = false, other = false;
		for (int d = 0; d < 3; d++) {
			g.cells[d] = 15, g.points[d] = points, g.h[d] = 0.1;
			g.face[d][0] = g.face[d][1] = walls ? PM_WALL : PM_PERIODIC;
		}
		int status = pm_operator_init(&o, &g, PM_OP_GRAD, 0, 1, false) || pm_operator_plan(&o, &plans);
		for (int k = 0; k < 2 && !status; k++) {
			out[k] = malloc(3 * size * sizeof **out);
			memcpy(phi, b, size * sizeof *phi);
			for (size_t i = 0; i < plane && k; i++)
				phi[5 * plane + i] = a[i];
			status = pm_operator_apply(&o, 1, (const double *const[]){phi}, (double *const[]){out[k], out[k] + size, out[k] + 2 * size}, &seen);
		}
		for (size_t i = 0; i < 2 * size && !status; i++) {
			const bool equal = !memcmp(out[0] + i, out[1] + i, sizeof **out);
			same &= equal || i % size / plane == 5;
			other |= !equal;
		}
		check(!status && same && other, "spectral d/dx and d/dy, %s: plane 5 of 15 changes no byte of another plane", walls ? "walls" : "periodic");
		free(phi), free(out[0]), free(out[1]);
		pm_fft_plans_clear(&plans);
	}
}

int main(void)
{
	stretches_of_sets();
	planes_of_meshes();
	families();
	threads();
	sets_apart();
	groups();
	planes_apart();
	return check_done();
}
