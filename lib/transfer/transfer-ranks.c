/* Spread and gather where the particles are divided in the order of the stream and the mesh in planes, by the jobs of shared-jobs.c. A job whose block lies
 * on the planes here is done as by a transfer alone, without a message. Of the others (the edge of a rank's jobs) a spread sends the rows, unsummed, to the
 * ranks that have their lines of the mesh, which add all rows of a line in the order of jobs: the sums of a transfer alone. A gather is the transpose: rows
 * of lines travel to the jobs, values back to the particles.
 * Travels, beside records: of tiles at an edge (1 + (width - 1)/edge)^dim numbers a cell and component; in a gather the values of records that travelled.
 * Memory: the rows of an edge, once where they come from, once where they go. SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "transfer/shared-jobs.h"
#include "world/world.h"

enum { LAYERS_MOST = 80 }; /* of a block: 64 + 11 in 2-D */
static const size_t inside = SIZE_MAX;

struct pass {
	struct pm_shared_jobs jobs;
	const struct pm_job_blocks *blocks; /* spread: NULL or those of another kind of records */
	struct pm_tile_target to;  /* the mesh under way; of all components of a pass the slots are on the same points */
	int threads;
	size_t *edge_of;           /* of each job of this rank: its number in the edge; inside: its block is on the planes here alone */
	size_t (*at)[LAYERS_MOST]; /* of each job of the edge, and of each layer of its block: the place among those of the layer's rank */
	size_t *size, *bytes;      /* [ranks] doubles of these layers, of a component; what is sent */
};

/* ---- layers of blocks ---- */

/* What a plane of the mesh takes of a block is a layer: in 3-D all rows of a slot z, in 2-D a row, in 1-D the block. */
struct layers {
	size_t first[3], n[3]; /* slots */
	size_t count, rows;    /* layers, rows of one */
	int dim;
};

static struct layers layers_of(const struct pass *a, size_t tile)
{
	struct layers l = {.dim = a->jobs.local->order.dim};
	for (int d = 0; d < 3; d++)
		l.n[d] = pm_tile_slots(&a->jobs.w.p, tile, d, &l.first[d]);
	l.count = l.dim == 1 ? 1 : l.n[l.dim - 1];
	l.rows = l.dim == 3 ? l.n[1] : 1;
	return l;
}

static size_t rank_of(const struct pass *a, const struct layers *l, size_t layer)
{
	const int d = l->dim - 1;
	return (size_t)a->jobs.holder[d ? a->to.axes[d]->at[l->first[d] + layer] : 0];
}

static bool is_on(const struct pass *a, const struct layers *l, bool here)
{
	for (size_t k = 0; k < l->count; k++)
		if ((rank_of(a, l, k) == a->jobs.me) == here)
			return true;
	return false;
}

/* Row i of a layer: slots, line of the mesh, place in the block. */
struct row {
	size_t z, y, line, in_block;
};

static struct row row_of(const struct pass *a, const struct layers *l, size_t layer, size_t i)
{
	struct row r = {.z = l->dim == 3 ? layer : 0, .y = l->dim == 3 ? i : layer};
	r.line = a->to.axes[2]->at[l->first[2] + r.z] * a->jobs.planes->points[1] + a->to.axes[1]->at[l->first[1] + r.y];
	r.in_block = (r.z * (size_t)pm_block_rows[l->dim] + r.y) * (size_t)pm_block_row[l->dim];
	return r;
}

/* Points of the line of a row, which is on a plane here. */
static size_t points_of(const struct pass *a, const struct row *r) { return (r->line - a->to.line) * a->jobs.planes->points[0]; }

/* A component of job i to its block. */
static void fill(const struct pass *a, size_t i, int value, double *block)
{
	const struct pm_pass w = pm_shared_jobs_pass(&a->jobs, i);
	if (a->blocks)
		a->blocks->fill(a->blocks->data, &w.p, &w.p.job[i], value, block);
	else
		pm_pass_spread(&w, &w.p.job[i], value, block);
}

/* Which jobs are at the edge, and where their layers are, on the points of the slots of `to`. share: jobs of one tile have them in common. */
static int find_edge_of(struct pass *a, const struct pm_tile_target *to, bool share)
{
	const struct pm_shared_jobs *v = &a->jobs;
	const struct pm_tile_job *job = v->w.p.job;
	size_t edges = 0;
	a->to = *to;
	a->to.line = pm_planes_row(v->planes, 0);
	a->edge_of = pm_alloc(v->w.p.jobs + 1, sizeof *a->edge_of);
	a->size = pm_zalloc(2 * v->ranks, sizeof *a->size);
	if (!a->edge_of || !a->size)
		return -PM_DATA;
	a->bytes = a->size + v->ranks;
	for (size_t i = 0; i < v->w.p.jobs; i++) {
		const struct layers l = layers_of(a, job[i].tile);
		a->edge_of[i] = !is_on(a, &l, false) ? inside : share && i && job[i].tile == job[i - 1].tile ? a->edge_of[i - 1] : edges++;
	}
	if (!(a->at = pm_alloc(edges + 1, sizeof *a->at)))
		return -PM_DATA;
	for (size_t i = 0, next = 0; i < v->w.p.jobs; i++) {
		const struct layers l = layers_of(a, job[i].tile);
		for (size_t k = 0; k < l.count && a->edge_of[i] == next; k++) {
			const size_t r = rank_of(a, &l, k);
			a->at[next][k] = a->size[r];
			a->size[r] += l.rows * l.n[0];
		}
		next += a->edge_of[i] == next;
	}
	return 0;
}

static int find_edge(struct pass *a, bool share)
{
	const struct pm_axis *x = a->jobs.local->axes;
	return find_edge_of(a, &(struct pm_tile_target){.axes = {&x[0], &x[1], &x[2]}}, share);
}

/* Where what is for or of each rank begins, but this one, which keeps its own: places in at[] count from there. Returns the doubles of all. */
static size_t begin_at(const struct pass *a, const size_t *size, size_t *begin)
{
	size_t all = 0;
	for (size_t r = 0; r < a->jobs.ranks; r++) {
		begin[r] = r == a->jobs.me ? 0 : all;
		all += r == a->jobs.me ? 0 : size[r];
	}
	return all;
}

static void pass_free(struct pass *a, bool keep)
{
	pm_free(a->edge_of), pm_free(a->at), pm_free(a->size);
	pm_shared_jobs_free(&a->jobs, keep);
}

/* Threads for the records of this rank's jobs, which may be more than its particles. */
static int threads_of(const struct pm_shared_jobs *v)
{
	const struct pm_tile_job *job = v->w.p.job;
	size_t n = 0;
	for (size_t i = 0; i < v->w.p.jobs; i++)
		n += job[i].to - job[i].from;
	return pm_tile_threads(n);
}

/* ---- spread ---- */

/* Blocks at the edge: layers for other ranks to out, from begin[] on, layers of this rank to own. */
static void fill_edge(const struct pass *a, int value, const size_t *begin, double *out, double *own)
{
	const struct pm_shared_jobs *v = &a->jobs;
#pragma omp parallel for schedule(dynamic, 1) num_threads(a->threads) if (a->threads > 1)
	for (size_t i = 0; i < v->w.p.jobs; i++) {
		double *block = v->w.blocks + (size_t)omp_get_thread_num() * PM_BLOCK_MOST;
		if (a->edge_of[i] == inside)
			continue;
		const struct layers l = layers_of(a, v->w.p.job[i].tile);
		fill(a, i, value, block);
		for (size_t k = 0; k < l.count; k++) {
			const size_t r = rank_of(a, &l, k);
			double *layer = (r == v->me ? own : out + begin[r]) + a->at[a->edge_of[i]][k];
			for (size_t y = 0; y < l.rows; y++) {
				double *row = block + row_of(a, &l, k, y).in_block;
				memcpy(layer + y * l.n[0], row, l.n[0] * sizeof *row);
				memset(row, 0, l.n[0] * sizeof *row);
			}
		}
	}
}

/* One layer of this rank's planes to the mesh; every thread has its own lines. */
static void add_layer(const struct pass *a, const struct layers *l, size_t layer, size_t thread, size_t share, double *rows, double *mesh)
{
	for (size_t y = 0; y < l->rows; y++) {
		const struct row r = row_of(a, l, layer, y);
		if (r.line % share == thread)
			pm_tile_add_row(&a->to, l->first, l->n[0], r.z, r.y, rows + y * l->n[0], mesh + points_of(a, &r));
	}
}

/* What came of the jobs from..end-1 of other ranks, in their order. Returns what is behind it. */
static double *add_others(const struct pass *a, size_t from, size_t end, double *came, double *mesh)
{
	double *behind = came;
#pragma omp parallel num_threads(a->threads) if (a->threads > 1)
	{
		const size_t share = (size_t)omp_get_num_threads(), thread = (size_t)omp_get_thread_num();
		double *at = came;
		for (size_t j = from; j < end; j++) {
			const struct layers l = layers_of(a, a->jobs.job[j].tile);
			for (size_t k = 0; k < l.count; k++)
				if (rank_of(a, &l, k) == a->jobs.me) {
					add_layer(a, &l, k, thread, share, at, mesh);
					at += l.rows * l.n[0];
				}
		}
		if (!thread)
			behind = at;
	}
	return behind;
}

/* The jobs of this rank, in waves as by a transfer alone; those at the edge have been made. */
static void add_own(const struct pass *a, int value, double *own, double *mesh)
{
	const struct pm_shared_jobs *v = &a->jobs;
	const struct pm_tile_job *job = v->w.p.job;
	const size_t under_way = pm_tile_under_way(a->threads);
#pragma omp parallel num_threads(a->threads) if (a->threads > 1)
	for (size_t from = 0; from < v->w.p.jobs; from += under_way) {
		const size_t end = v->w.p.jobs - from < under_way ? v->w.p.jobs : from + under_way, thread = (size_t)omp_get_thread_num();
#pragma omp for schedule(dynamic, 1)
		for (size_t i = from; i < end; i++)
			if (a->edge_of[i] == inside)
				fill(a, i, value, v->w.blocks + (i - from) * PM_BLOCK_MOST);
		for (size_t i = from; i < end; i++) {
			if (a->edge_of[i] == inside) {
				pm_tile_add_block(&v->w.p, &job[i], &a->to, (int)thread, a->threads, v->w.blocks + (i - from) * PM_BLOCK_MOST, mesh);
				continue;
			}
			const struct layers l = layers_of(a, job[i].tile);
			for (size_t k = 0; k < l.count; k++)
				if (rank_of(a, &l, k) == v->me)
					add_layer(a, &l, k, thread, (size_t)a->threads, own + a->at[a->edge_of[i]][k], mesh);
		}
#pragma omp barrier
	}
}

static int spread(int status, struct pass *a, int value, double *mesh)
{
	const struct pm_shared_jobs *v = &a->jobs;
	size_t *begin = status ? NULL : pm_alloc(2 * v->ranks, sizeof *begin), all = 0;
	double *out = NULL, *own = NULL;
	void *came = NULL;
	status = status ? status : begin ? 0 : pm_failed();
	if (!status) {
		if (!a->blocks) {
			a->to.flip = v->t->flip[v->w.which[value]];
			a->to.scale = 1 / pm_grid_cell(&v->t->grid);
		}
		all = begin_at(a, a->size, begin);
		out = pm_alloc(all + 1, sizeof *out);
		own = pm_alloc(a->size[v->me] + 1, sizeof *own);
		status = out && own ? 0 : pm_failed();
	}
	for (size_t r = 0; r < v->ranks && !status; r++)
		a->bytes[r] = r == v->me ? 0 : a->size[r] * sizeof *out;
	if (!status)
		fill_edge(a, value, begin, out, own);
	status = pm_world_exchange(status, out, a->bytes, &came, begin ? begin + v->ranks : NULL);
	pm_free(out);
	if (!status) {
		double *behind = add_others(a, 0, v->job_of[v->me], came, mesh);
		add_own(a, value, own, mesh);
		add_others(a, v->job_of[v->me + 1], v->jobs, behind, mesh);
	}
	pm_free(came), pm_free(own), pm_free(begin);
	return status;
}

int pm_spread_ranks(const struct pm_transfer *t, size_t n, const double *const x[], const double *const strength[], double *const mesh[],
	struct pm_strays *strays)
{
	bool done[PM_COMPONENTS] = {false};
	struct pass a = {.jobs = {.t = t}};
	int status = 0;
	while (!status && pm_pass_next(t, done, &a.jobs.w)) {
		struct pm_pass *w = &a.jobs.w;
		const double *values[PM_COMPONENTS];
		for (int c = 0; c < w->components; c++)
			values[c] = strength[w->which[c]];
		status = pm_shared_jobs_init(status, &a.jobs, n, x, w->components, values, 0);
		status = status ? status : find_edge(&a, false);
		a.threads = status ? 1 : threads_of(&a.jobs);
		status = status ? status : pm_pass_squares(w, a.threads, 1);
		if (!status && !(w->blocks = pm_zalloc(pm_tile_under_way(a.threads) * PM_BLOCK_MOST, sizeof *w->blocks)))
			status = pm_failed();
		status = pm_world_agree(status);
		for (int c = 0; c < w->components && !status; c++)
			status = spread(status, &a, c, mesh[w->which[c]]);
		if (!status)
			*strays = a.jobs.local->strays;
		pass_free(&a, !status);
		a = (struct pass){.jobs = {.t = t}};
	}
	return status;
}

int pm_spread_jobs_ranks(int status, const struct pm_transfer *t, struct pm_order_cache *local, const struct pm_job_blocks *b, double *const mesh[])
{
	struct pass a = {.jobs = {.t = t, .local = local}, .blocks = b};
	status = pm_shared_jobs_of_order(status, &a.jobs, local ? local->order.nvalues : 0, 0);
	if (!status && !(a.jobs.w.blocks = pm_zalloc(pm_tile_under_way(threads_of(&a.jobs)) * PM_BLOCK_MOST, sizeof(double))))
		status = pm_failed();
	status = pm_world_agree(status ? status : b->begin(b->data, a.jobs.w.p.jobs, threads_of(&a.jobs)));
	for (int c = 0; c < b->n && !status; c++) {
		pm_free(a.edge_of), pm_free(a.at), pm_free(a.size);
		a.edge_of = NULL, a.at = NULL, a.size = NULL;
		a.threads = threads_of(&a.jobs);
		status = spread(find_edge_of(&a, &b->to[c], false), &a, c, mesh[c]);
	}
	pass_free(&a, false);
	return status;
}

/* ---- gather ---- */

/* Layers of planes here for the jobs of each other rank; consecutive jobs of a tile share them. out NULL: size[] becomes the doubles of a component. Else
 * what each gets begins at begin[], component by component. */
static void layers_for_jobs(struct pass *a, const double *const mesh[], const size_t *begin, size_t *size, double *out)
{
	const struct pm_shared_jobs *v = &a->jobs;
	for (size_t r = 0; r < v->ranks; r++) {
		size_t at = 0;
		for (size_t j = v->job_of[r]; j < v->job_of[r + 1] && r != v->me; j++) {
			const struct layers l = layers_of(a, v->job[j].tile);
			if (j > v->job_of[r] && v->job[j].tile == v->job[j - 1].tile)
				continue;
			for (size_t k = 0; k < l.count; k++) {
				if (rank_of(a, &l, k) != v->me)
					continue;
				for (size_t i = 0; i < l.rows * (size_t)v->w.components && out; i++) {
					const size_t c = i / l.rows, y = i % l.rows;
					const struct row row = row_of(a, &l, k, y);
					a->to.flip = v->t->flip[v->w.which[c]];
					pm_tile_load_row(&a->to, l.first, l.n[0], row.z, row.y, mesh[v->w.which[c]] + points_of(a, &row),
						out + begin[r] + c * size[r] + at + y * l.n[0]);
				}
				at += l.rows * l.n[0];
			}
		}
		if (!out)
			size[r] = at;
	}
}

static int send_layers(int status, struct pass *a, const double *const mesh[], void **came)
{
	const struct pm_shared_jobs *v = &a->jobs;
	const size_t k = (size_t)v->w.components;
	size_t *size = status ? NULL : pm_zalloc(3 * v->ranks, sizeof *size), *begin = size ? size + v->ranks : NULL;
	double *out = NULL;
	status = status ? status : size ? 0 : pm_failed();
	if (!status) {
		layers_for_jobs(a, mesh, NULL, size, NULL);
		const size_t all = begin_at(a, size, begin) * k;
		for (size_t r = 0; r < v->ranks; r++)
			begin[r] *= k, a->bytes[r] = size[r] * k * sizeof *out;
		if (!(out = pm_alloc(all + 1, sizeof *out)))
			status = pm_failed();
	}
	if (!status)
		layers_for_jobs(a, mesh, begin, size, out);
	status = pm_world_exchange(status, out, a->bytes, came, size ? size + 2 * v->ranks : NULL);
	pm_free(out), pm_free(size);
	return status;
}

/* The block of a component at the edge: layers of other ranks from what came, others from the mesh. */
static void load_edge(const struct pass *a, const struct pm_tile_target *to, size_t i, int c, const size_t *begin, const double *came, const double *mesh,
	double *block)
{
	const struct pm_shared_jobs *v = &a->jobs;
	const struct layers l = layers_of(a, v->w.p.job[i].tile);
	for (size_t k = 0; k < l.count; k++) {
		const size_t r = rank_of(a, &l, k);
		const double *layer = came + begin[r] * (size_t)v->w.components + (size_t)c * a->size[r] + a->at[a->edge_of[i]][k];
		for (size_t y = 0; y < l.rows; y++) {
			const struct row row = row_of(a, &l, k, y);
			if (r == v->me)
				pm_tile_load_row(to, l.first, l.n[0], row.z, row.y, mesh + points_of(a, &row), block + row.in_block);
			else
				memcpy(block + row.in_block, layer + y * l.n[0], l.n[0] * sizeof *block);
		}
	}
}

/* The values of the records of this rank's jobs. 0, or failure; *bad where one of those that are at their place already is not finite. */
static int gather_jobs(const struct pass *a, const double *came, const double *const mesh[], const struct pm_tile_results *results, int *bad)
{
	const struct pm_shared_jobs *v = &a->jobs;
	size_t *begin = pm_alloc(v->ranks, sizeof *begin);
	int worse = 0;
	if (!begin)
		return -PM_DATA;
	begin_at(a, a->size, begin);
#pragma omp parallel for schedule(dynamic, 1) num_threads(a->threads) reduction(| : worse) if (a->threads > 1)
	for (size_t i = 0; i < v->w.p.jobs; i++) {
		double *block = v->w.blocks + (size_t)omp_get_thread_num() * (size_t)v->w.components * PM_BLOCK_MOST;
		for (int c = 0; c < v->w.components; c++) {
			struct pm_tile_target to = a->to;
			to.flip = v->t->flip[v->w.which[c]];
			if (a->edge_of[i] == inside)
				pm_tile_load_block(&v->w.p, &v->w.p.job[i], &to, mesh[v->w.which[c]], block + (size_t)c * PM_BLOCK_MOST);
			else
				load_edge(a, &to, i, c, begin, came, mesh[v->w.which[c]], block + (size_t)c * PM_BLOCK_MOST);
		}
		const struct pm_pass w = pm_shared_jobs_pass(v, i);
		worse |= !pm_pass_gather(&w, &v->w.p.job[i], block, results);
	}
	*bad |= worse;
	pm_free(begin);
	return 0;
}

/* n values of the particles from `at` on in the order of tiles: to their results, or, where the stream has this order, to their places. */
static void put_back(const struct pass *a, size_t at, size_t n, const double *values, size_t stride, const struct pm_tile_results *r, int *bad)
{
	const struct pm_shared_jobs *v = &a->jobs;
	const struct pm_tile_order *o = &v->local->order;
	const size_t k = (size_t)v->w.components, to = v->w.results ? k : (size_t)o->stride;
	double *results = v->w.results ? v->w.results : o->records;
	for (size_t p = 0; p < n && o->tile; p++)
		memcpy(results + (at + p) * to, values + p * stride, k * sizeof *values);
	for (size_t p = 0, m; p < n && !o->tile; p += m) {
		m = n - p < PM_TILE_ORDER_PACK ? n - p : PM_TILE_ORDER_PACK;
		*bad |= !pm_tile_results_unpack(at + p, m, (int)stride, values + p * stride, (int)k, r);
	}
}

/* The values of copies: to the ranks that sent their records, and to the particles here. */
static int send_back(int status, struct pass *a, const struct pm_tile_results *r, int *bad)
{
	struct pm_shared_jobs *v = &a->jobs;
	const size_t k = (size_t)v->w.components, stride = (size_t)v->mixed.order.stride;
	size_t n = 0, *came = status ? NULL : pm_alloc(v->ranks, sizeof *came);
	for (size_t q = 0; q < v->ranks && !status; q++)
		n += v->in[q], a->bytes[q] = v->in[q] * k * sizeof(double);
	double *out = status ? NULL : pm_alloc(n * k + 1, sizeof *out);
	void *back = NULL;
	status = status ? status : out && came ? 0 : pm_failed();
	for (size_t i = 0; i < n && !status; i++)
		memcpy(out + i * k, v->mixed.order.records + v->place[i] * stride, k * sizeof *out);
	status = pm_world_exchange(status, out, a->bytes, &back, came);
	if (!status) {
		const double *values = back;
		const size_t end = v->local->order.begin[v->local->order.tiles];
		put_back(a, 0, v->sent[0], values, k, r, bad);
		put_back(a, v->sent[1], end - v->sent[1], values + v->sent[0] * k, k, r, bad);
		for (size_t i = 0; i < v->w.p.jobs; i++)
			if (v->own[i].mixed)
				put_back(a, v->own[i].local, v->own[i].here, v->mixed.order.records + v->own[i].copy * stride, stride, r, bad);
	}
	pm_free(out), pm_free(back), pm_free(came);
	return status;
}

static int begin_gather(struct pass *a)
{
	struct pm_pass *w = &a->jobs.w;
	const struct pm_tile_order *o = &a->jobs.local->order;
	const size_t k = (size_t)w->components;
	a->threads = threads_of(&a->jobs);
	if (o->tile && k > (size_t)o->stride && !(w->results = pm_alloc(o->n * k + 1, sizeof *w->results)))
		return -PM_DATA;
	w->blocks = pm_zalloc((size_t)a->threads * k * PM_BLOCK_MOST, sizeof *w->blocks);
	return !w->blocks ? -PM_DATA : !PM_TILE_CIC_EIGHT ? 0 : pm_pass_vectors(w, a->threads);
}

/* One pass, with its jobs. */
static int gather(int status, struct pass *a, const double *const mesh[], const struct pm_tile_results *results, bool *finite)
{
	struct pm_shared_jobs *v = &a->jobs;
	void *came = NULL;
	int bad = 0;
	status = status ? status : find_edge(a, true);
	status = status ? status : begin_gather(a);
	status = send_layers(status, a, mesh, &came);
	status = status ? status : gather_jobs(a, came, mesh, results, &bad);
	pm_free(came);
	status = send_back(status, a, results, &bad);
	*finite = !bad;
	if (!status && v->local->order.tile) {
		const struct pm_tile_order *o = &v->local->order;
		const int k = v->w.components;
		status = pm_tile_results_return(o, v->w.results ? v->w.results : o->records, v->w.results ? k : o->stride, k, results, finite);
		if (!v->w.results)
			pm_tile_order_spend(&v->local->order);
	}
	return status;
}

int pm_gather_ranks(const struct pm_transfer *t, size_t n, const double *const x[], const double *const mesh[], const double *const factor[],
	double *const out[], struct pm_strays *strays)
{
	bool done[PM_COMPONENTS] = {false}, finite = true;
	struct pass a = {.jobs = {.t = t}};
	int status = 0;
	while (!status && pm_pass_next(t, done, &a.jobs.w)) {
		struct pm_target to[PM_COMPONENTS];
		struct pm_column times[PM_COMPONENTS];
		bool set[PM_COMPONENTS], seen = false;
		for (int c = 0; c < a.jobs.w.components; c++) {
			const int k = a.jobs.w.which[c];
			set[c] = t->set[k], to[c] = (struct pm_target){.doubles = out[k]};
			times[c] = (struct pm_column){.doubles = factor ? factor[k] : NULL, .value = 1};
		}
		const struct pm_tile_results results = {.factor = times, .set = set, .to = to};
		status = pm_shared_jobs_init(status, &a.jobs, n, x, 0, NULL, a.jobs.w.components);
		status = gather(status, &a, mesh, &results, &seen);
		status = pm_world_agree(status);
		finite = finite && seen;
		if (!status)
			*strays = a.jobs.local->strays;
		pass_free(&a, false);
		a = (struct pass){.jobs = {.t = t}};
	}
	strays->finite = finite;
	return status;
}
