/* Spread and gather by tiles of cells: particles are sorted by tile (tile-order.c), each tile has its own block without faces (transfer-tile.c), and blocks
 * are added to or read from the mesh here, where points beyond a face are folded back with the sign of their image. A point's sum is
 * made of its tiles' sums, in the order of the tiles, each in the order of the stream: the same bytes for any number of threads.
 * Cost: two passes over the particles for the order, width^dim products each, a pass over the mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <string.h>

#include "transfer/order-cache.h"

enum {
	piece = 16384, /* particles per job: a crowded tile is divided among threads */
	wave = 32      /* jobs per thread between two barriers */
};

struct job {
	size_t tile, from, to; /* records */
};

/* One pass: the components that sit at the same offset. */
struct pass {
	const struct pm_transfer *t;
	int components, which[PM_COMPONENTS];
	struct pm_order_cache *o;
	size_t jobs;
	struct job *job;
	double *blocks; /* [threads or jobs under way][components at once][PM_BLOCK_MOST] */
	double *results; /* gather: [n][components] where the records are not to be overwritten, else NULL */
	double *corners; /* NULL or [threads][PM_TILE_CELLS][PM_CORNERS], zero */
};

/* The slots of a tile: first cell, and how many. */
static size_t tile_slots(const struct pass *w, size_t tile, int d, size_t *first)
{
	const uint32_t *across = w->o->order.across;
	size_t edge = (size_t)1 << pm_tile_shift[w->o->order.dim][d];
	size_t at = d == 0 ? tile % across[0] : d == 1 ? tile / across[0] % across[1] : tile / across[0] / across[1];
	const struct pm_axis *a = &w->o->axes[d];
	*first = at * edge;
	return (a->count - *first < edge ? a->count - *first : edge) + (a->slots - a->count);
}

static int list_jobs(struct pass *w)
{
	size_t most = w->o->order.tiles + w->o->order.n / piece;
	w->job = pm_alloc(most < w->o->order.n ? most : w->o->order.n, sizeof *w->job);
	if (!w->job)
		return -PM_DATA;
	for (size_t tile = 0; tile < w->o->order.tiles; tile++)
		for (size_t at = w->o->order.begin[tile], end = w->o->order.begin[tile + 1]; at < end; at += piece)
			w->job[w->jobs++] = (struct job){tile, at, end - at < piece ? end : at + piece};
	return 0;
}

static struct pm_tile tile_of(const struct pass *w, const struct job *j, double *block)
{
	struct pm_tile t = {.kernel = w->t->kernel, .shift = w->o->axes[0].shift, .count = j->to - j->from, .stride = w->o->order.stride, .block = block};
	if (w->o->order.records)
		t.records = w->o->order.records + j->from * (size_t)w->o->order.stride;
	t.results = w->results ? w->results + j->from * (size_t)w->components : t.records;
	t.to = w->results ? w->components : t.stride;
	for (int d = 0; d < 3; d++)
		tile_slots(w, j->tile, d, &t.cell[d]);
	return t;
}

/* One row of a block to the mesh, times factor; the row is zero afterwards. */
static void add_row(const struct pm_axis *a, const double *put, size_t first, size_t n, double factor, double *restrict row, double *restrict mesh)
{
	size_t slot = first, end = first + n, from = a->from < end ? a->from : end, to = a->to < end ? a->to : end;
	for (; slot < from; slot++)
		mesh[a->at[slot]] += factor * put[slot] * row[slot - first];
	if (slot < to) {
		double *restrict points = mesh + a->at[slot], *restrict values = row + (slot - first);
		size_t m = to - slot;
		for (size_t i = 0; i < m; i++)
			points[i] += factor * values[i];
		slot = to;
	}
	for (; slot < end; slot++)
		mesh[a->at[slot]] += factor * put[slot] * row[slot - first];
	memset(row, 0, n * sizeof *row);
}

/* The rows of a job's block that belong to this thread. */
static void add_block(const struct pass *w, const struct job *j, int c, int thread, int threads, double *block, double *mesh)
{
	const struct pm_grid *g = &w->t->grid;
	const unsigned char *flip = w->t->flip[c];
	const struct pm_axis *a = w->o->axes;
	size_t first[3], n[3], row = (size_t)pm_block_row[g->dim], plane = row * (size_t)pm_block_rows[g->dim];
	double scale = 1 / pm_grid_cell(g);
	for (int d = 0; d < 3; d++)
		n[d] = tile_slots(w, j->tile, d, &first[d]);
	for (size_t z = 0; z < n[2]; z++)
		for (size_t y = 0; y < n[1]; y++) {
			size_t sz = first[2] + z, sy = first[1] + y, line = a[2].at[sz] * g->points[1] + a[1].at[sy];
			if (line % (size_t)threads == (size_t)thread)
				add_row(&a[0], a[0].put[flip[0]], first[0], n[0], scale * a[2].put[flip[2]][sz] * a[1].put[flip[1]][sy],
					block + z * plane + y * row, mesh + line * g->points[0]);
		}
}

/* Threads worth starting for n particles. */
static int threads_for(size_t n)
{
	size_t most = n / 4096 + 1;
	return (size_t)pm_threads() < most ? pm_threads() : (int)most;
}

/* One thread adds each block at once, while it is in the cache. */
static size_t jobs_under_way(int threads) { return threads == 1 ? 1 : wave * (size_t)threads; }

/* The particles of a job to its block. */
static void spread_job(const struct pass *w, const struct job *j, int value, double *block)
{
	struct pm_tile t = tile_of(w, j, block);
	bool corners = pm_tile_has_corners(w->o->order.dim, w->t->kernel, t.count);
	pm_tile_loop *loop = pm_tile_spread(w->o->order.dim, w->t->kernel, corners);
	double packed[PM_TILE_ORDER_PACK * (PM_COMPONENTS + 3) + 4];
	t.value = w->o->order.dim + value;
	t.corners = corners ? w->corners + (size_t)omp_get_thread_num() * PM_TILE_CELLS * PM_CORNERS : NULL;
	if (t.records)
		loop(&t);
	for (size_t p = j->from; p < j->to && !w->o->order.records; p += t.count) {
		t.count = j->to - p < PM_TILE_ORDER_PACK ? j->to - p : PM_TILE_ORDER_PACK;
		t.records = packed;
		pm_tile_order_pack(&w->o->order, p, t.count, packed);
		loop(&t);
	}
	if (corners) {
		size_t cells[3], first;
		for (int d = 0; d < 3; d++)
			cells[d] = tile_slots(w, j->tile, d, &first) - (w->o->axes[d].slots - w->o->axes[d].count);
		pm_tile_fold(&t, cells);
	}
}

/* Jobs are done in waves: every thread fills blocks of the wave, then adds to its own mesh lines from all blocks in order. */
static void spread_component(const struct pass *w, int value, int threads, double *mesh)
{
	size_t under_way = jobs_under_way(threads);
#pragma omp parallel num_threads(threads)
	for (size_t from = 0; from < w->jobs; from += under_way) {
		size_t to = w->jobs - from < under_way ? w->jobs : from + under_way;
#pragma omp for schedule(dynamic, 1)
		for (size_t j = from; j < to; j++)
			spread_job(w, &w->job[j], value, w->blocks + (j - from) * PM_BLOCK_MOST);
		for (size_t j = from; j < to; j++)
			add_block(w, &w->job[j], w->which[value], omp_get_thread_num(), threads, w->blocks + (j - from) * PM_BLOCK_MOST, mesh);
#pragma omp barrier
	}
}

/* A row of the mesh to a block. */
static void load_row(const struct pm_axis *a, const double *get, size_t first, size_t n, double factor, const double *restrict mesh,
	double *restrict row)
{
	size_t slot = first, end = first + n, from = a->from < end ? a->from : end, to = a->to < end ? a->to : end;
	for (; slot < from; slot++)
		row[slot - first] = factor * get[slot] * mesh[a->at[slot]];
	if (slot < to) {
		const double *points = mesh + a->at[slot];
		for (size_t i = slot; i < to; i++)
			row[i - first] = factor * points[i - slot];
		slot = to;
	}
	for (; slot < end; slot++)
		row[slot - first] = factor * get[slot] * mesh[a->at[slot]];
}

static void load_block(const struct pass *w, const struct job *j, int c, const double *mesh, double *block)
{
	const struct pm_grid *g = &w->t->grid;
	const unsigned char *flip = w->t->flip[c];
	const struct pm_axis *a = w->o->axes;
	size_t first[3], n[3], row = (size_t)pm_block_row[g->dim], plane = row * (size_t)pm_block_rows[g->dim];
	for (int d = 0; d < 3; d++)
		n[d] = tile_slots(w, j->tile, d, &first[d]);
	for (size_t z = 0; z < n[2]; z++)
		for (size_t y = 0; y < n[1]; y++) {
			size_t sz = first[2] + z, sy = first[1] + y, line = a[2].at[sz] * g->points[1] + a[1].at[sy];
			load_row(&a[0], a[0].get[flip[0]], first[0], n[0], a[2].get[flip[2]][sz] * a[1].get[flip[1]][sy],
				mesh + line * g->points[0], block + z * plane + y * row);
		}
}

/* The place of the values of a stream that is in order; otherwise they stay in the records. */
struct results {
	const double *const *factor;
	const bool *set;
	double *const *to;
};

static bool gather_in_order(const struct pass *w, const struct job *j, struct pm_tile t, pm_tile_loop *loop, const struct results *r)
{
	double packed[PM_TILE_ORDER_PACK * (PM_COMPONENTS + 3) + 4];
	bool finite = true;
	t.records = t.results = packed;
	t.to = t.stride;
	for (size_t p = j->from; p < j->to; p += t.count) {
		t.count = j->to - p < PM_TILE_ORDER_PACK ? j->to - p : PM_TILE_ORDER_PACK;
		pm_tile_order_pack(&w->o->order, p, t.count, packed);
		loop(&t);
		finite &= pm_tile_order_unpack(p, t.count, t.stride, packed, w->components, r->factor, r->set, r->to);
	}
	return finite;
}

/* True if the values are finite; those in records are checked later. */
static bool gather_pass(const struct pass *w, int threads, const double *const mesh[], const struct results *r)
{
	pm_tile_loop *loop = pm_tile_gather(w->o->order.dim, w->t->kernel);
	int bad = 0;
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1) reduction(| : bad)
	for (size_t j = 0; j < w->jobs; j++) {
		double *block = w->blocks + (size_t)omp_get_thread_num() * (size_t)w->components * PM_BLOCK_MOST;
		struct pm_tile t = tile_of(w, &w->job[j], block);
		t.components = w->components;
		for (int c = 0; c < w->components; c++)
			load_block(w, &w->job[j], w->which[c], mesh[w->which[c]], block + (size_t)c * PM_BLOCK_MOST);
		if (t.records)
			loop(&t);
		else
			bad |= !gather_in_order(w, &w->job[j], t, loop, r);
	}
	return !bad;
}

/* The next pass: the first component not yet done, and all with the same offset. False if there is none. */
static bool next_pass(const struct pm_transfer *t, bool done[], struct pass *w)
{
	*w = (struct pass){.t = t};
	for (int c = 0; c < t->components; c++)
		if (!done[c] && (!w->components || !memcmp(t->staggered[c], t->staggered[w->which[0]], sizeof t->staggered[c]))) {
			done[c] = true;
			w->which[w->components++] = c;
		}
	return w->components > 0;
}

/* Blocks for at most `at_once` jobs of `each` components. */
static int begin_pass(struct pass *w, size_t at_once, size_t each)
{
	int status = w->o ? list_jobs(w) : -PM_DATA;
	at_once = at_once < w->jobs ? at_once : w->jobs;
	w->blocks = status ? NULL : pm_zalloc(at_once * each * PM_BLOCK_MOST, sizeof *w->blocks);
	return w->blocks ? 0 : -PM_DATA;
}

/* The particles in order, with the values that go along. */
static int begin_spread(struct pass *w, size_t n, const double *const x[], const double *const strength[], int threads)
{
	const double *values[PM_COMPONENTS];
	for (int c = 0; c < w->components; c++)
		values[c] = strength[w->which[c]];
	w->o = pm_order_cache_new(w->t, w->t->staggered[w->which[0]], n, x, w->components, values, 0);
	return begin_pass(w, jobs_under_way(threads), 1);
}

/* A kept order must not be changed, so the results get their own memory. */
static int begin_gather(struct pass *w, size_t n, const double *const x[], int threads)
{
	const unsigned char *staggered = w->t->staggered[w->which[0]];
	w->o = pm_order_cache_find(w->t, staggered, n, x);
	bool found = w->o && w->o->order.records;
	if (!w->o)
		w->o = pm_order_cache_new(w->t, staggered, n, x, 0, NULL, w->components);
	if (found && !(w->results = pm_alloc(n * (size_t)w->components, sizeof *w->results)))
		return -PM_DATA;
	return begin_pass(w, (size_t)threads, (size_t)w->components);
}

static int corners_for(struct pass *w, int threads)
{
	bool used = false;
	for (size_t j = 0; j < w->jobs && !used; j++)
		used = pm_tile_has_corners(w->o->order.dim, w->t->kernel, w->job[j].to - w->job[j].from);
	if (used)
		w->corners = pm_zalloc((size_t)threads * PM_TILE_CELLS * PM_CORNERS, sizeof *w->corners);
	return used && !w->corners ? -PM_DATA : 0;
}

static void end_pass(struct pass *w)
{
	pm_free(w->corners);
	pm_free(w->blocks);
	pm_free(w->job);
	pm_free(w->results);
}

int pm_spread(const struct pm_transfer *t, size_t n, const double *const x[], const double *const strength[], double *const mesh[],
	struct pm_strays *strays)
{
	bool done[PM_COMPONENTS] = {false};
	struct pass w;
	int status = 0, threads = threads_for(n);
	*strays = (struct pm_strays){.count = 0};
	while (n && !status && next_pass(t, done, &w)) {
		status = begin_spread(&w, n, x, strength, threads);
		status = status ? status : corners_for(&w, threads);
		for (int c = 0; c < w.components && !status; c++)
			spread_component(&w, c, threads, mesh[w.which[c]]);
		if (!status)
			*strays = w.o->strays;
		end_pass(&w);
		pm_order_cache_leave(t, w.o);
	}
	return status;
}

int pm_gather(const struct pm_transfer *t, size_t n, const double *const x[], const double *const mesh[], const double *const factor[],
	double *const out[], struct pm_strays *strays)
{
	bool done[PM_COMPONENTS] = {false}, finite = true;
	struct pass w;
	int status = 0, threads = threads_for(n);
	*strays = (struct pm_strays){.count = 0};
	while (n && !status && next_pass(t, done, &w)) {
		double *to[PM_COMPONENTS];
		const double *times[PM_COMPONENTS];
		bool set[PM_COMPONENTS];
		for (int c = 0; c < w.components; c++) {
			set[c] = t->set[w.which[c]];
			to[c] = out[w.which[c]];
			times[c] = factor ? factor[w.which[c]] : NULL;
		}
		const struct results r = {times, set, to};
		status = begin_gather(&w, n, x, threads);
		bool seen = !status && gather_pass(&w, (size_t)threads < w.jobs ? threads : (int)w.jobs + !w.jobs, mesh, &r);
		const struct pm_tile_order *o = status ? NULL : &w.o->order;
		if (o && o->records)
			status = pm_tile_order_return(o, w.results ? w.results : o->records, w.results ? w.components : o->stride, w.components, times, set,
				to, &seen);
		finite = finite && seen;
		if (!status)
			*strays = w.o->strays;
		bool in_use = t->kept && *t->kept == &w.o->note;
		end_pass(&w);
		if (!in_use) /* its records have been overwritten */
			pm_order_cache_free(w.o);
	}
	strays->finite = finite;
	return status;
}

/* Cells missing below and above on one axis. floor + 1: one cell to spare against rounding. */
static int grow_axis(const struct pm_grid *g, int d, double r, size_t n, const double *x, double *below, double *above)
{
	double least = INFINITY, most = -INFINITY, cells = (double)g->cells[d];
	for (size_t p = 0; p < n; p++) {
		double s = (x[p] - g->lo[d]) / g->h[d];
		least = fmin(least, s);
		most = fmax(most, s);
	}
	*below = g->face[d][0] != PM_PERIODIC && least < r ? floor(r - least) + 1 : 0;
	*above = g->face[d][0] != PM_PERIODIC && most > cells - r ? floor(most - (cells - r)) + 1 : 0;
	for (int side = 0; side < 2; side++) {
		bool closed = g->face[d][side] == PM_WALL || g->face[d][side] == PM_NEUMANN;
		if (closed && (side ? most > cells : least < 0))
			return pm_fail(PM_DATA, "particles are beyond the %s face of axis %c, but only open faces can be moved (move them back, or use "
				"--outside drop)",
				pm_face_names[g->face[d][side]], "xyz"[d]);
		if (closed)
			*(side ? above : below) = 0;
	}
	return 0;
}

int pm_transfer_grow(const struct pm_transfer *t, size_t n, const double *const x[], size_t below[3], size_t above[3])
{
	double points = 1;
	for (int d = 0; d < t->grid.dim; d++) {
		double low = 0, high = 0;
		int status = n ? grow_axis(&t->grid, d, 0.5 * t->kernel->width + t->rim, n, x[d], &low, &high) : 0;
		if (status)
			return status;
		points *= (double)t->grid.cells[d] + low + high + 1;
		if (points > PM_TRANSFER_POINTS)
			return pm_fail(PM_DATA, "the mesh would grow to more than %g points to hold every particle (--outside drop leaves far ones out)",
				(double)PM_TRANSFER_POINTS);
		below[d] = (size_t)low;
		above[d] = (size_t)high;
	}
	return 0;
}
