/* Speed of spread and gather, million particles per second: kernels in random and in tile order, one scalar and (gather) a vector, beside FINUFFT where its
 * library is found (finufft.h) and pmesh where bench/pmesh-painter.py found it.
 * transfer [cells per axis [particles per cell [dim [kernel ...]]]], `all` for all kernels; on one thread and, where there are more, on all.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/tile-order.h"

#include "finufft.h"

struct run {
	struct pm_transfer t;
	size_t n, cells, per_cell;
	int gathered;      /* components; 0: spread */
	double *x[3], *q, *mesh[3], *out[3];
};

/* Particles at random, or the same in the order of p2m's tiles, which kernels of an odd number of points have half a cell lower. */
static void place(struct run *r, bool ordered)
{
	int dim = r->t.grid.dim;
	const double lower = r->t.kernel && r->t.kernel->width % 2 ? 0.5 : 0;
	size_t cells = r->t.grid.cells[0], volume = r->per_cell, edge[3];
	for (int d = 0; d < dim; d++) {
		edge[d] = (size_t)1 << pm_tile_shift[dim][d];
		edge[d] = edge[d] < cells ? edge[d] : cells;
		volume *= edge[d];
	}
#pragma omp parallel for
	for (size_t p = 0; p < r->n; p++) {
		size_t tile = p / volume;
		for (int d = 0; d < dim; d++) {
			double u[2];
			pm_random(1, p, (uint64_t)d, u);
			r->x[d][p] = ordered ? (double)(tile % (cells / edge[d]) * edge[d]) + u[0] * (double)edge[d] - lower : u[0] * (double)cells;
			tile /= cells / edge[d];
		}
		r->q[p] = 1;
	}
}

/* Whether tiles fill the axes, so that place() can put particles into their order. */
static bool tiles_fill(int dim, size_t cells)
{
	bool fill = true;
	for (int d = 0; d < dim; d++)
		fill = fill && (cells >> pm_tile_shift[dim][d] == 0 || cells % ((size_t)1 << pm_tile_shift[dim][d]) == 0);
	return fill;
}

static void pass(void *with)
{
	struct run *r = with;
	struct pm_strays strays;
	r->t.components = r->gathered ? r->gathered : 1;
	int status = r->gathered ? pm_gather(&r->t, r->n, (const double *const *)r->x, (const double *const *)r->mesh, NULL, r->out, &strays)
				 : pm_spread(&r->t, r->n, (const double *const *)r->x, (const double *const *)&r->q, r->mesh, &strays);
	if (status)
		exit(1);
}

/* The obvious loop: cic in 3-D, periodic, particle by particle, like the painter of pmesh. */
static void by_hand(void *with)
{
	const struct run *r = with;
	const size_t n = r->cells;
	const double per = r->t.grid.h[0];
	for (size_t p = 0; p < r->n; p++) {
		size_t at[3][2];
		double w[3][2], sum = 0;
		for (int d = 0; d < 3; d++) {
			double u = r->x[d][p] / per, below = floor(u);
			w[d][1] = u - below, w[d][0] = 1 - w[d][1];
			at[d][0] = (size_t)below, at[d][1] = at[d][0] + 1 < n ? at[d][0] + 1 : 0;
		}
		for (int c = 0; c < 8; c++) {
			double *node = r->mesh[0] + (at[2][c >> 2] * n + at[1][c >> 1 & 1]) * n + at[0][c & 1],
				weight = w[2][c >> 2] * w[1][c >> 1 & 1] * w[0][c & 1];
			if (r->gathered)
				sum += weight * *node;
			else
				*node += weight * r->q[p];
		}
		if (r->gathered)
			r->out[0][p] += sum;
	}
}

/* Published rates of other codes on their own machines, 3-D, one thread; 0 unknown. */
static double recorded(const struct run *r, bool ordered, int width)
{
	static const double finufft[2][7] = {{0, 0, 21, 16.7, 16.8, 0, 10.3}, {0, 0, 9.4, 10.6, 10.2, 0, 5.8}};
	static const double pmesh[7] = {0, 107, 59.5, 32.4, 14.5, 0, 0};
	if (r->t.grid.dim != 3 || width > 6)
		return 0;
	return ordered ? pmesh[width] : pm_threads() == 1 ? finufft[r->gathered > 0][width] : 0;
}

static double target(const struct run *r, bool ordered, int width)
{
	if (ordered)
		return r->gathered ? 3 : width > 2 ? 0 : r->per_cell > 1 ? 4 : 2.5;
	return r->gathered || width == 2 ? 4 : 3;
}

/* One transfer, FINUFFT in turn with it; vector: a gather of dim components in turn with one of a scalar. */
static void measure(struct run *r, struct finufft *finufft, bool ordered)
{
	struct run vector = *r;
	const int dim = r->t.grid.dim, width = r->t.kernel->width;
	double nodes = pow(width, dim), density = (double)r->per_cell;
	bool peer = finufft && !ordered && finufft_plan(finufft, r->gathered ? 2 : 1, width < 2 ? 2 : width);
	char name[96];
	vector.gathered = dim;
	struct bench_job jobs[4] = {{pass, r, {0}}};
	const bool plain = ordered && dim == 3 && !strcmp(r->t.kernel->name, "cic");
	int n = 1, at_peer = peer ? n++ : 0, at_vector = r->gathered ? n++ : 0, at_plain = plain ? n++ : 0;
	if (peer)
		jobs[at_peer] = (struct bench_job){finufft_run, finufft, {0}};
	if (r->gathered)
		jobs[at_vector] = (struct bench_job){pass, &vector, {0}};
	if (plain)
		jobs[at_plain] = (struct bench_job){by_hand, r, {0}};
	bench_turns(n, jobs);
	snprintf(name, sizeof name, "%s %s, %d-D %zu, %zu a cell", r->t.kernel->name, ordered ? "in tiles" : "random", dim, r->cells, r->per_cell);
	/* Random order: positions and strength are read, written in order (with the line read first) and read again. The mesh once per cell. */
	double record = 8. * (dim + 1), bytes = (ordered ? record : 4 * record) + 16 / density;
	double live = bench_look("PM_PEERS", r->gathered ? "pmesh gather" : "pmesh spread", r->t.kernel->name, 1);
	struct bench_row row = {.kernel = r->gathered ? "m2p" : "p2m", .name = name, .unit = "M/s", .per = 1e6, .bytes = bytes,
		.flops = 2 * nodes + dim * width * 2. * (width - 1), .stream = "triad-nt", .least = target(r, ordered, width)};
	if (ordered && isfinite(live)) {
		row.against = "pmesh", row.other = live;
		bench_rate(row, (double)r->n, &jobs[0]);
	} else {
		bench_against(row, (double)r->n, &jobs[0], ordered ? "pmesh" : "FINUFFT", peer ? &jobs[at_peer] : NULL, recorded(r, ordered, width));
	}
	if (plain)
		bench_against(row, (double)r->n, &jobs[0], "plain loop", &jobs[at_plain], 0);
	if (r->gathered && dim > 1)
		bench_rate((struct bench_row){.kernel = "m2p", .name = strcat(name, ", vector"), .unit = "M/s", .per = 1e6, .bytes = bytes + 8 * (dim - 1),
			.stream = "triad-nt",
			.flops = row.flops + 2 * nodes * (dim - 1), .against = "time of a scalar", .other = (double)r->n / bench_median(&jobs[0]) / 1e6,
			.ratio = bench_faster(&jobs[at_vector], &jobs[0]), .most = 1.7}, (double)r->n, &jobs[at_vector]);
	if (peer)
		finufft->destroy(finufft->plan);
}

/* Speed-up of spread and gather on all threads, by wall time. */
static void threads(struct run *r, int most)
{
	for (r->gathered = 0; r->gathered < 2; r->gathered++) {
		double quotient[BENCH_ROUNDS];
		struct bench_job all = {pass, r, {0}};
		for (int i = -1; i < BENCH_ROUNDS; i++) {
			double t[3];
			for (int k = 0; k < 2; k++) {
				pm_threads_use(k ? most : 1);
				t[0] = pm_seconds();
				pass(r);
				t[k + 1] = pm_seconds() - t[0];
			}
			if (i >= 0)
				all.seconds[i] = t[2], quotient[i] = t[1] / t[2];
		}
		char name[96];
		snprintf(name, sizeof name, "%s random, %d-D %zu, %d threads", r->t.kernel->name, r->t.grid.dim, r->cells, most);
		bench_rate((struct bench_row){.kernel = r->gathered ? "m2p" : "p2m", .name = name, .unit = "M/s", .per = 1e6, .against = "one thread",
			.other = NAN, .ratio = bench_middle(quotient).median, .least = 0.925 * most}, (double)r->n, &all);
	}
}

static struct run run_new(size_t cells, size_t per_cell, int dim)
{
	struct run r = {.t.grid = {.dim = dim}, .t.cleared = true, .n = per_cell, .cells = cells, .per_cell = per_cell};
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
	return r;
}

int main(int argc, char **argv)
{
	size_t cells = argc > 1 ? strtoul(argv[1], NULL, 10) : 128, per_cell = argc > 2 ? strtoul(argv[2], NULL, 10) : 1;
	int dim = argc > 3 ? atoi(argv[3]) : 3, most = pm_threads();
	const char *usual[] = {"cic", "tsc", "pcs", "m6prime"}, **names = argc > 4 ? (const char **)argv + 4 : usual;
	int n = argc > 4 ? argc - 4 : 4;
	struct run r = run_new(cells, per_cell, dim);
	struct finufft finufft;
	if (argc > 4 && !strcmp(argv[4], "all"))
		for (n = 0, names = (const char **)pm_kernel_names; names[n];)
			n++;
	bool peer = finufft_open(&finufft);
	const bool fill = tiles_fill(dim, r.cells);
	if (!fill)
		fprintf(stderr, "transfer: no rows in the order of tiles (CELLS is no multiple of their edges)\n");
	for (int ordered = 0; ordered < 1 + fill; ordered++) {
		if (!ordered)
			place(&r, false);
		if (peer && !ordered)
			finufft_fill(&finufft, dim, cells, r.n, r.x);
		pm_threads_use(1);
		for (int i = 0; i < n; i++) {
			r.t.kernel = pm_kernel_find(names[i]);
			if (ordered)
				place(&r, true);
			for (r.gathered = 0; r.t.kernel && r.gathered < 2; r.gathered++)
				measure(&r, peer ? &finufft : NULL, ordered);
		}
		pm_threads_use(most);
		if (most > 1 && !ordered && (r.t.kernel = pm_kernel_find(names[0])))
			threads(&r, most);
	}
	return 0;
}
