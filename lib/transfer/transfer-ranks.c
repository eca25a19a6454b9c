/* Spread and gather where the particles are divided in the order of the stream and the mesh in planes. The unit is the job of a transfer alone: a tile's
 * records in the order of the stream, at most PM_TILE_PIECE of them. Counts per tile, added over the ranks, define the jobs; these are dealt in the order of
 * tiles by equal numbers of records, so a crowded tile is shared too. Records travel to the rank of their job. A spread sends the rows of the job's block,
 * unsummed, to the ranks that have their lines of the mesh, which add them in the order of jobs: the sums of a transfer alone. A gather is the transpose:
 * lines become rows of blocks where they are, rows travel to the jobs, values back to the particles.
 * Travels: of a record dim + values numbers there, in a gather its values back; of each tile (1 + (width - 1)/edge)^dim numbers a cell and component.
 * Memory: two copies of the records under way, and the blocks of a rank's jobs. SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <stdlib.h>
#include <string.h>

#include "transfer/transfer-pass.h"
#include "world/world.h"

enum { ROWS_MOST = 384 }; /* of a block */

struct travel {
	const struct pm_transfer *t;
	const struct pm_planes *planes;
	size_t ranks, me;
	struct pm_order_cache *local; /* the particles here, by tile */
	bool in_order;                /* as the stream has them */
	struct pm_order_cache mine;   /* records of the jobs of this rank */
	struct pm_pass w;             /* its jobs */
	int64_t *total, *before;      /* [tiles] records, of all ranks and of those before this one */
	size_t jobs;                  /* of all ranks */
	struct pm_tile_job *job;      /* from, to: in the order of all records */
	size_t *job_of, *record_of;   /* the first job and record of every rank, one more than ranks */
	size_t *out, *in;             /* [ranks] bytes; behind those that came of records those of rows */
	size_t *place;                /* of each record that came, in the order of jobs */
	int *holder;                  /* of each plane */
};

static void travel_free(struct travel *v)
{
	pm_free(v->mine.order.records);
	pm_order_cache_free(v->local);
	pm_free(v->total), pm_free(v->job), pm_free(v->place);
	free(v->job_of), free(v->holder);
	pm_pass_end(&v->w);
}

/* ---- jobs, and records to them ---- */

static int count(int status, struct travel *v)
{
	const struct pm_tile_order *o = v->local ? &v->local->order : NULL;
	const size_t tiles = o ? o->tiles : 0;
	v->total = status ? NULL : pm_alloc(2 * tiles + 1, sizeof *v->total);
	status = status ? status : v->total ? 0 : pm_failed();
	v->before = v->total ? v->total + tiles : NULL;
	for (size_t i = 0; v->total && i < tiles; i++)
		v->total[i] = v->before[i] = (int64_t)(o->begin[i + 1] - o->begin[i]);
	status = pm_world_count(status, PM_SUM_OF, tiles, v->total);
	return pm_world_count(status, PM_SUM_BEFORE, tiles, v->before);
}

static int deal(struct travel *v)
{
	const size_t tiles = v->local->order.tiles;
	size_t all = 0, most = 0, at = 0, rank = 0;
	for (size_t i = 0; i < tiles; i++) {
		all += (size_t)v->total[i];
		most += ((size_t)v->total[i] + PM_TILE_PIECE - 1) / PM_TILE_PIECE;
	}
	v->job = pm_alloc(most + 1, sizeof *v->job);
	v->job_of = calloc(5 * (v->ranks + 1), sizeof *v->job_of);
	v->holder = malloc((v->planes->all + 1) * sizeof *v->holder);
	if (!v->job || !v->job_of || !v->holder)
		return pm_no_memory();
	v->record_of = v->job_of + v->ranks + 1, v->out = v->record_of + v->ranks + 1, v->in = v->out + v->ranks;
	for (size_t i = 0; i < tiles; i++)
		for (size_t end = at + (size_t)v->total[i]; at < end; at = v->job[v->jobs++].to) {
			for (; rank < at * v->ranks / all; rank++)
				v->job_of[rank + 1] = v->jobs, v->record_of[rank + 1] = at;
			v->job[v->jobs] = (struct pm_tile_job){i, at, end - at < PM_TILE_PIECE ? end : at + PM_TILE_PIECE};
		}
	for (; rank < v->ranks; rank++)
		v->job_of[rank + 1] = v->jobs, v->record_of[rank + 1] = at;
	for (size_t r = 0; r < v->ranks; r++)
		for (size_t k = v->planes->from[r]; k < v->planes->from[r + 1]; k++)
			v->holder[k] = (int)r;
	return 0;
}

/* How many records of this rank each rank needs: in the order of tiles they are in the order of ranks. */
static void records_out(struct travel *v)
{
	size_t at = 0, rank = 0;
	for (size_t i = 0; i < v->local->order.tiles; at += (size_t)v->total[i++]) {
		size_t a = at + (size_t)v->before[i];
		const size_t *begin = v->local->order.begin, end = a + begin[i + 1] - begin[i];
		while (a < end) {
			while (v->record_of[rank + 1] <= a)
				rank++;
			const size_t to = v->record_of[rank + 1] < end ? v->record_of[rank + 1] : end;
			v->out[rank] += to - a;
			a = to;
		}
	}
}

static void in_bytes(size_t *count, size_t ranks, size_t bytes)
{
	for (size_t r = 0; r < ranks; r++)
		count[r] *= bytes;
}

static size_t tile_of(const struct travel *v, const double *u)
{
	const struct pm_tile_order *o = &v->local->order;
	size_t tile = 0;
	for (int d = o->dim - 1; d >= 0; d--)
		tile = tile * o->across[d] + ((size_t)u[d] >> pm_tile_shift[o->dim][d]);
	return tile;
}

/* What came is in the order of ranks, so of the stream, and of each rank by tile: a stable sort by tile puts it in the order of jobs. */
static int sort(struct travel *v, const double *came, size_t n)
{
	const size_t first = v->job_of[v->me], jobs = v->job_of[v->me + 1] - first, begin = v->record_of[v->me], stride = (size_t)v->mine.order.stride;
	const size_t least = jobs ? v->job[first].tile : 0, tiles = jobs ? v->job[first + jobs - 1].tile - least + 1 : 0;
	size_t *cursor = pm_alloc(tiles + 1, sizeof *cursor);
	double *records = pm_alloc(n * stride + 4, sizeof *records); /* 4: records are read as vectors */
	v->place = pm_alloc(n + 1, sizeof *v->place);
	v->w.p.job = pm_alloc(jobs + 1, sizeof *v->w.p.job);
	v->mine.order.records = records;
	if (!cursor || !records || !v->place || !v->w.p.job)
		return pm_free(cursor), -PM_DATA;
	for (size_t i = jobs; i-- > 0;) {
		const struct pm_tile_job *j = &v->job[first + i];
		v->w.p.job[i] = (struct pm_tile_job){j->tile, j->from - begin, j->to - begin};
		cursor[j->tile - least] = j->from - begin; /* of several the first */
	}
	v->w.p.jobs = jobs;
	for (size_t i = 0; i < n; i++) {
		v->place[i] = cursor[tile_of(v, came + i * stride) - least]++;
		memcpy(records + v->place[i] * stride, came + i * stride, stride * sizeof *records);
	}
	memset(records + n * stride, 0, 4 * sizeof *records);
	pm_free(cursor);
	return 0;
}

/* The records here in the order of tiles, also where the stream has it. */
static double *packed(const struct pm_tile_order *o)
{
	double *records = pm_alloc(o->n * (size_t)o->stride + 1, sizeof *records);
	for (size_t p = 0; records && p < o->n; p += PM_TILE_ORDER_PACK)
		pm_tile_order_pack(o, p, o->n - p < PM_TILE_ORDER_PACK ? o->n - p : PM_TILE_ORDER_PACK, true, records + p * (size_t)o->stride);
	return records;
}

/* Jobs and records of a pass. Takes the caller's status and returns the agreed one. */
static int begin(int status, struct travel *v, size_t n, const double *const x[], int nvalues, const double *const values[])
{
	v->ranks = (size_t)pm_world_size(), v->me = (size_t)pm_world_rank();
	v->planes = v->t->planes;
	if (!status && !(v->local = pm_order_cache_new(v->t, v->t->staggered[v->w.which[0]], n, x, nvalues, values, 0)))
		status = pm_failed();
	status = pm_world_agree(status); /* all know the number of tiles */
	if (status)
		return status;
	struct pm_tile_order *o = &v->local->order;
	double *own = o->records;
	v->in_order = !own;
	void *came = NULL;
	status = count(status, v);
	status = status ? status : deal(v);
	if (!status && !own && !(own = packed(o)))
		status = pm_failed();
	status = pm_world_agree(status);
	if (!status) {
		const size_t bytes = (size_t)o->stride * sizeof *own;
		records_out(v);
		in_bytes(v->out, v->ranks, bytes);
		status = pm_world_exchange(status, own, v->out, &came, v->in);
		if (own != o->records)
			pm_free(own);
		o->records = pm_free(o->records);
		v->mine = (struct pm_order_cache){.grid = v->t->grid, .order = {.dim = o->dim, .tiles = o->tiles, .stride = o->stride, .nvalues = nvalues}};
		memcpy(v->mine.axes, v->local->axes, sizeof v->mine.axes);
		memcpy(v->mine.order.across, o->across, sizeof o->across);
		v->mine.order.axes = v->mine.axes;
		v->mine.order.n = status ? 0 : v->record_of[v->me + 1] - v->record_of[v->me];
		v->w.o = &v->mine;
		v->w.p = (struct pm_tile_pass){.grid = &v->t->grid, .order = &v->mine.order, .axes = v->mine.axes};
		status = status ? status : sort(v, came, v->mine.order.n);
	}
	pm_free(came);
	return status;
}

/* ---- rows of blocks, and the lines of the mesh ---- */

/* A row of the block of a tile: the rank of its line, the line there, its length. */
struct row {
	size_t rank, line, count;
};

static struct row row_of(const struct travel *v, size_t tile, const struct pm_tile_target *to, size_t z, size_t y)
{
	struct row r;
	const size_t line = pm_tile_line(&v->w.p, tile, to, z, y, &r.count);
	r.rank = (size_t)v->holder[line * v->planes->points[0] / v->planes->size];
	r.line = line - pm_planes_row(v->planes, 0);
	return r;
}

/* Rows of a plane, and of the whole block of a tile. */
static void shape_of(const struct travel *v, size_t tile, size_t rows[2])
{
	size_t first;
	rows[0] = pm_tile_slots(&v->w.p, tile, 1, &first);
	rows[1] = rows[0] * pm_tile_slots(&v->w.p, tile, 2, &first);
}

static double *in_block(const struct travel *v, double *block, size_t z, size_t y)
{
	const int dim = v->mine.order.dim;
	return block + (z * (size_t)pm_block_rows[dim] + y) * (size_t)pm_block_row[dim];
}

/* Doubles of the rows of a tile to or from each rank are added to `sum`; at: NULL, or what sum was before each row. */
static void add_rows(const struct travel *v, size_t tile, const struct pm_tile_target *to, size_t *sum, size_t *at)
{
	size_t rows[2];
	shape_of(v, tile, rows);
	for (size_t i = 0; i < rows[1]; i++) {
		const struct row r = row_of(v, tile, to, i / rows[0], i % rows[0]);
		if (at)
			at[i] = sum[r.rank];
		sum[r.rank] += r.count;
	}
}

static void begin_at(size_t *sum, size_t ranks)
{
	for (size_t r = 0, at = 0; r < ranks; r++) {
		const size_t n = sum[r];
		sum[r] = at;
		at += n;
	}
}

/* The blocks of this rank's jobs, as rows in the order of ranks. */
static void fill_rows(const struct travel *v, int value, const struct pm_tile_target *to, int threads, size_t *sum, size_t (*at)[ROWS_MOST], double *out)
{
	const size_t under_way = pm_tile_under_way(threads);
	for (size_t from = 0; from < v->w.p.jobs; from += under_way) {
		const size_t end = v->w.p.jobs - from < under_way ? v->w.p.jobs : from + under_way;
		for (size_t j = from; j < end; j++)
			add_rows(v, v->w.p.job[j].tile, to, sum, at[j - from]);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) if (threads > 1)
		for (size_t j = from; j < end; j++) {
			double *block = v->w.blocks + (j - from) * PM_BLOCK_MOST;
			size_t rows[2], tile = v->w.p.job[j].tile;
			shape_of(v, tile, rows);
			pm_pass_spread(&v->w, &v->w.p.job[j], value, block);
			for (size_t i = 0; i < rows[1]; i++) {
				double *row = in_block(v, block, i / rows[0], i % rows[0]);
				const size_t n = row_of(v, tile, to, i / rows[0], i % rows[0]).count;
				memcpy(out + at[j - from][i], row, n * sizeof *row);
				memset(row, 0, n * sizeof *row);
			}
		}
	}
}

/* The rows of all jobs that belong to lines here, added in the order of jobs; every thread has its own lines. */
static void add_to_lines(const struct travel *v, const struct pm_tile_target *to, int threads, double *rows_in, double *mesh)
{
#pragma omp parallel num_threads(threads) if (threads > 1)
	{
		const size_t share = (size_t)omp_get_num_threads(), thread = (size_t)omp_get_thread_num();
		double *row = rows_in;
		for (size_t j = 0; j < v->jobs; j++) {
			size_t rows[2], tile = v->job[j].tile;
			shape_of(v, tile, rows);
			for (size_t i = 0; i < rows[1]; i++) {
				const struct row r = row_of(v, tile, to, i / rows[0], i % rows[0]);
				if (r.rank != v->me)
					continue;
				if (r.line % share == thread)
					pm_tile_add_row(&v->w.p, tile, to, i / rows[0], i % rows[0], row, mesh + r.line * v->planes->points[0]);
				row += r.count;
			}
		}
	}
}

static int spread(int status, struct travel *v, int value, int threads, double *mesh)
{
	const struct pm_axis *a = v->mine.axes;
	const struct pm_tile_target to = {.axes = {&a[0], &a[1], &a[2]}, .flip = v->t->flip[v->w.which[value]], .scale = 1 / pm_grid_cell(&v->t->grid)};
	size_t all = 0, *sum = calloc(v->ranks, sizeof *sum), (*at)[ROWS_MOST] = pm_alloc(pm_tile_under_way(threads), sizeof *at);
	double *out = NULL;
	void *in = NULL;
	status = status ? status : sum && at ? 0 : pm_no_memory();
	for (size_t j = 0; j < v->w.p.jobs && !status; j++)
		add_rows(v, v->w.p.job[j].tile, &to, sum, NULL);
	for (size_t r = 0; r < v->ranks && !status; r++)
		all += sum[r], v->out[r] = sum[r] * sizeof *out;
	if (!status && !(out = pm_alloc(all + 1, sizeof *out)))
		status = pm_failed();
	if (!status) {
		begin_at(sum, v->ranks);
		fill_rows(v, value, &to, threads, sum, at, out);
	}
	size_t *came = v->in + v->ranks;
	status = pm_world_exchange(status, out, v->out, &in, came);
	pm_free(out);
	if (!status)
		add_to_lines(v, &to, threads, in, mesh);
	pm_free(in), pm_free(at), free(sum);
	return status;
}

int pm_spread_ranks(const struct pm_transfer *t, size_t n, const double *const x[], const double *const strength[], double *const mesh[],
	struct pm_strays *strays)
{
	bool done[PM_COMPONENTS] = {false};
	struct travel v = {.t = t};
	int status = 0, threads = pm_tile_threads(n);
	while (!status && pm_pass_next(t, done, &v.w)) {
		const double *values[PM_COMPONENTS];
		for (int c = 0; c < v.w.components; c++)
			values[c] = strength[v.w.which[c]];
		status = begin(status, &v, n, x, v.w.components, values);
		status = status ? status : pm_pass_corners(&v.w, threads, 1);
		if (!status && !(v.w.blocks = pm_zalloc(pm_tile_under_way(threads) * PM_BLOCK_MOST, sizeof *v.w.blocks)))
			status = pm_failed();
		status = pm_world_agree(status);
		for (int c = 0; c < v.w.components && !status; c++)
			status = spread(status, &v, c, threads, mesh[v.w.which[c]]);
		if (!status)
			*strays = v.local->strays;
		travel_free(&v);
		v = (struct travel){.t = t};
	}
	return status;
}

/* ---- gather ---- */

/* Rows of a component for the tiles of every rank's jobs, of the lines here; consecutive jobs of a tile share them. out NULL: only their lengths. */
static void rows_for_jobs(const struct travel *v, const struct pm_tile_target *to, const double *mesh, size_t *sum, double *out)
{
	size_t at = 0;
	for (size_t r = 0; r < v->ranks; r++)
		for (size_t j = v->job_of[r]; j < v->job_of[r + 1]; j++) {
			size_t rows[2], tile = v->job[j].tile;
			if (j > v->job_of[r] && tile == v->job[j - 1].tile)
				continue;
			shape_of(v, tile, rows);
			for (size_t i = 0; i < rows[1]; i++) {
				const struct row w = row_of(v, tile, to, i / rows[0], i % rows[0]);
				if (w.rank != v->me)
					continue;
				if (out)
					pm_tile_load_row(&v->w.p, tile, to, i / rows[0], i % rows[0], mesh + w.line * v->planes->points[0], out + at);
				else
					sum[r] += w.count;
				at += w.count;
			}
		}
}

static struct pm_tile_target target(const struct travel *v, int c)
{
	const struct pm_axis *a = v->mine.axes;
	return (struct pm_tile_target){.axes = {&a[0], &a[1], &a[2]}, .flip = v->t->flip[v->w.which[c]]};
}

static int send_rows(int status, struct travel *v, int c, const double *mesh, void **in)
{
	const struct pm_tile_target to = target(v, c);
	size_t all = 0, *sum = calloc(v->ranks, sizeof *sum);
	double *out = NULL;
	status = status ? status : sum ? 0 : pm_no_memory();
	if (!status)
		rows_for_jobs(v, &to, NULL, sum, NULL);
	for (size_t r = 0; r < v->ranks && !status; r++)
		all += sum[r], v->out[r] = sum[r] * sizeof *out;
	if (!status && !(out = pm_alloc(all + 1, sizeof *out)))
		status = pm_failed();
	if (!status)
		rows_for_jobs(v, &to, mesh, sum, out);
	status = pm_world_exchange(status, out, v->out, in, v->in + v->ranks);
	pm_free(out), free(sum);
	return status;
}

/* The values of the records of this rank's jobs from the rows that came, component by component. */
static int gather_jobs(const struct travel *v, int threads, double *const rows_in[])
{
	const size_t under_way = pm_tile_under_way(threads), each = (size_t)v->w.components * PM_BLOCK_MOST;
	const struct pm_tile_target to = target(v, 0);
	pm_tile_loop *loop = pm_tile_gather(v->mine.order.dim, v->t->kernel);
	size_t *sum = calloc(v->ranks, sizeof *sum), (*at)[ROWS_MOST] = pm_alloc(under_way + 1, sizeof *at);
	if (!sum || !at)
		return free(sum), pm_free(at), pm_no_memory();
	for (size_t r = 0; r < v->ranks; r++)
		sum[r] = v->in[v->ranks + r] / sizeof(double);
	begin_at(sum, v->ranks);
	const struct pm_tile_job *job = v->w.p.job;
	for (size_t from = 0; from < v->w.p.jobs; from += under_way) {
		const size_t end = v->w.p.jobs - from < under_way ? v->w.p.jobs : from + under_way;
		for (size_t j = from; j < end; j++) /* at[0]: of the job before */
			if (j && job[j].tile == job[j - 1].tile)
				memcpy(at[j - from + 1], at[j - from], sizeof *at);
			else
				add_rows(v, job[j].tile, &to, sum, at[j - from + 1]);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) if (threads > 1)
		for (size_t j = from; j < end; j++) {
			double *block = v->w.blocks + (size_t)omp_get_thread_num() * each;
			struct pm_tile t = pm_pass_tile(&v->w, &job[j], block);
			size_t rows[2];
			t.components = v->w.components;
			shape_of(v, job[j].tile, rows);
			for (size_t i = 0; i < rows[1]; i++)
				for (int c = 0; c < v->w.components; c++)
					memcpy(in_block(v, block + (size_t)c * PM_BLOCK_MOST, i / rows[0], i % rows[0]), rows_in[c] + at[j - from + 1][i],
						row_of(v, job[j].tile, &to, i / rows[0], i % rows[0]).count * sizeof *block);
			loop(&t);
		}
		memcpy(at[0], at[end - from], sizeof *at);
	}
	free(sum), pm_free(at);
	return 0;
}

/* Values of all components back to the ranks of their particles, in the order of tiles there. */
static int send_back(int status, struct travel *v, void **back)
{
	const size_t n = v->mine.order.n, k = (size_t)v->w.components, stride = (size_t)v->mine.order.stride;
	double *out = status ? NULL : pm_alloc(n * k + 1, sizeof *out);
	status = status ? status : out ? 0 : pm_failed();
	for (size_t i = 0; i < n && out; i++)
		memcpy(out + i * k, v->w.results + v->place[i] * k, k * sizeof *out);
	for (size_t r = 0; r < v->ranks; r++)
		v->out[r] = v->in[r] / stride * k;
	status = pm_world_exchange(status, out, v->out, back, v->in);
	pm_free(out);
	return status;
}

/* One pass; *back: the values of the particles here. */
static int gather(int status, struct travel *v, int threads, const double *const mesh[], void **back)
{
	void *rows_in[PM_COMPONENTS] = {NULL};
	const size_t k = (size_t)v->w.components;
	if (!status) {
		v->w.results = pm_alloc(v->mine.order.n * k + 1, sizeof *v->w.results);
		v->w.blocks = pm_zalloc((size_t)threads * k * PM_BLOCK_MOST, sizeof *v->w.blocks);
		status = v->w.results && v->w.blocks ? 0 : pm_failed();
	}
	for (int c = 0; c < v->w.components; c++)
		status = send_rows(status, v, c, mesh[v->w.which[c]], &rows_in[c]);
	if (!status)
		status = gather_jobs(v, threads, (double *const *)rows_in);
	for (int c = 0; c < v->w.components; c++)
		pm_free(rows_in[c]);
	return send_back(status, v, back);
}

/* The values that came back, in the order of tiles, to the particles here. */
static int to_particles(const struct travel *v, const double *back, const double *const times[], const bool set[], double *const to[], bool *finite)
{
	const struct pm_tile_order *o = &v->local->order;
	const int k = v->w.components;
	int bad = 0;
	if (!v->in_order)
		return pm_tile_order_return(o, back, k, k, times, set, to, finite);
#pragma omp parallel for schedule(static) reduction(| : bad) if (o->n > 16384)
	for (size_t p = 0; p < o->n; p += PM_TILE_ORDER_PACK)
		bad |= !pm_tile_order_unpack(p, o->n - p < PM_TILE_ORDER_PACK ? o->n - p : PM_TILE_ORDER_PACK, k, back + p * (size_t)k, k, times, set, to);
	*finite = !bad;
	return 0;
}

int pm_gather_ranks(const struct pm_transfer *t, size_t n, const double *const x[], const double *const mesh[], const double *const factor[],
	double *const out[], struct pm_strays *strays)
{
	bool done[PM_COMPONENTS] = {false}, finite = true;
	struct travel v = {.t = t};
	int status = 0, threads = pm_tile_threads(n);
	while (!status && pm_pass_next(t, done, &v.w)) {
		double *to[PM_COMPONENTS];
		const double *times[PM_COMPONENTS];
		bool set[PM_COMPONENTS], seen = false;
		void *back = NULL;
		for (int c = 0; c < v.w.components; c++) {
			const int k = v.w.which[c];
			set[c] = t->set[k], to[c] = out[k], times[c] = factor ? factor[k] : NULL;
		}
		status = begin(status, &v, n, x, 0, NULL);
		status = pm_world_agree(status);
		if (!status)
			status = gather(status, &v, threads, mesh, &back);
		if (!status)
			status = to_particles(&v, back, times, set, to, &seen);
		status = pm_world_agree(status);
		finite = finite && seen;
		if (!status)
			*strays = v.local->strays;
		pm_free(back);
		travel_free(&v);
		v = (struct travel){.t = t};
	}
	strays->finite = finite;
	return status;
}
