/* The jobs of a transfer dealt among the ranks. A job is what a transfer alone has: a tile's records in the order of the stream, at most PM_TILE_PIECE of them.
 * Counts per tile, added over the ranks, define the jobs; these are dealt in the order of tiles by equal numbers of records, so that a crowded tile is shared
 * too. A job all of whose records are here takes them where they are, from the stream itself where it is in the order of tiles. Only jobs with records of
 * several ranks are made of copies: in a sorted stream, one layer of tiles at each end of a rank.
 * Travels: of a record that another rank needs dim + values numbers. Memory: the records that travel, and copies of those of mixed jobs.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "transfer/shared-jobs.h"
#include "world/world.h"

static int count(int status, struct pm_shared_jobs *v)
{
	const struct pm_tile_order *o = v->local ? &v->local->order : NULL;
	const size_t tiles = o ? o->tiles : 0;
	v->total = status ? NULL : pm_alloc(2 * tiles + 1, sizeof *v->total);
	status = status ? status : v->total ? 0 : pm_failed();
	v->at = v->total ? v->total + tiles : NULL;
	for (size_t i = 0; v->total && i < tiles; i++)
		v->total[i] = v->at[i] = (int64_t)(o->begin[i + 1] - o->begin[i]);
	status = pm_world_count(status, PM_SUM_OF, tiles, v->total);
	return pm_world_count(status, PM_SUM_BEFORE, tiles, v->at);
}

static int deal(struct pm_shared_jobs *v)
{
	const size_t tiles = v->local->order.tiles;
	size_t all = 0, most = 0, at = 0, rank = 0;
	for (size_t i = 0; i < tiles; i++) {
		v->at[i] += (int64_t)all;
		all += (size_t)v->total[i];
		most += ((size_t)v->total[i] + PM_TILE_PIECE - 1) / PM_TILE_PIECE;
	}
	v->job = pm_alloc(most + 1, sizeof *v->job);
	v->job_of = calloc(4 * (v->ranks + 1), sizeof *v->job_of);
	v->holder = malloc((v->planes->all + 1) * sizeof *v->holder);
	if (!v->job || !v->job_of || !v->holder)
		return pm_no_memory();
	v->record_of = v->job_of + v->ranks + 1, v->out = v->record_of + v->ranks + 1, v->in = v->out + v->ranks + 1;
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

/* How many records of this rank each other rank needs: in the order of tiles they are in the order of ranks, so that its own lie between two ends. */
static void records_out(struct pm_shared_jobs *v)
{
	const size_t *begin = v->local->order.begin;
	size_t rank = 0, lower = 0;
	for (size_t i = 0; i < v->local->order.tiles; i++) {
		size_t a = (size_t)v->at[i];
		const size_t end = a + begin[i + 1] - begin[i];
		while (a < end) {
			while (v->record_of[rank + 1] <= a)
				rank++;
			const size_t to = v->record_of[rank + 1] < end ? v->record_of[rank + 1] : end;
			v->out[rank] += to - a;
			a = to;
		}
	}
	for (size_t r = 0; r < v->me; r++)
		lower += v->out[r];
	v->sent[0] = lower, v->sent[1] = lower + v->out[v->me];
	v->out[v->me] = 0;
}

/* n records of an order from one on, also where the stream has it. */
static void copy(const struct pm_tile_order *o, size_t from, size_t n, size_t width, size_t stride, double *to)
{
	double packed[PM_TILE_ORDER_PACK * (PM_COMPONENTS + 3)];
	const size_t have = (size_t)o->stride;
	for (size_t p = 0, m; p < n; p += m) {
		const double *records = o->records ? o->records + (from + p) * have : packed;
		m = n - p < PM_TILE_ORDER_PACK ? n - p : PM_TILE_ORDER_PACK;
		if (!o->records)
			pm_tile_order_pack(o, from + p, m, true, packed);
		for (size_t i = 0; i < m; i++)
			memcpy(to + (p + i) * stride, records + i * have, width * sizeof *to);
	}
}

static size_t tile_of(const struct pm_tile_order *o, const double *u)
{
	size_t tile = 0;
	for (int d = o->dim - 1; d >= 0; d--)
		tile = tile * o->across[d] + ((size_t)u[d] >> pm_tile_shift[o->dim][d]);
	return tile;
}

static size_t most_of(size_t a, size_t b) { return a > b ? a : b; }
static size_t least_of(size_t a, size_t b) { return a < b ? a : b; }

/* The jobs of this rank: which are mixed, and where their copies begin; cursor: of each tile from the first one on. Returns the number of copies. */
static size_t list_own(struct pm_shared_jobs *v, size_t least, size_t *cursor)
{
	const size_t *begin = v->local->order.begin, first = v->job_of[v->me];
	size_t copies = 0;
	for (size_t i = 0; i < v->w.p.jobs; i++) {
		const struct pm_tile_job *j = &v->job[first + i];
		const size_t at = (size_t)v->at[j->tile], end = at + begin[j->tile + 1] - begin[j->tile], n = j->to - j->from;
		const size_t from = most_of(at, j->from), to = most_of(from, least_of(end, j->to)), local = begin[j->tile] + from - at;
		v->own[i] = (struct pm_own_job){.mixed = to - from < n, .local = local, .here = to - from};
		v->w.p.job[i] = (struct pm_tile_job){j->tile, v->own[i].mixed ? copies : local, v->own[i].mixed ? copies + n : local + n};
		if (!v->own[i].mixed)
			continue;
		if (!i || cursor[j->tile - least] == SIZE_MAX)
			cursor[j->tile - least] = copies; /* of several the first */
		copies += n;
	}
	return copies;
}

/* What came is in the order of ranks, so of the stream, and of each rank by tile: a stable sort by tile puts it in the order of jobs. The records here take
 * their turn. came: [records][width]. */
static int mix(struct pm_shared_jobs *v, const double *came, size_t width)
{
	struct pm_tile_order *m = &v->mixed.order;
	const size_t first = v->job_of[v->me], jobs = v->job_of[v->me + 1] - first, stride = (size_t)m->stride;
	const size_t least = jobs ? v->job[first].tile : 0, tiles = jobs ? v->job[first + jobs - 1].tile - least + 1 : 0;
	size_t *cursor = pm_alloc(tiles + 1, sizeof *cursor), all = 0, q = 0;
	for (size_t r = 0; r < v->ranks; r++)
		all += v->in[r];
	v->place = pm_alloc(all + 1, sizeof *v->place);
	v->w.p.job = pm_alloc(jobs + 1, sizeof *v->w.p.job);
	v->own = pm_alloc(jobs + 1, sizeof *v->own);
	if (!cursor || !v->place || !v->w.p.job || !v->own)
		return pm_free(cursor), -PM_DATA;
	memset(cursor, 0xff, tiles * sizeof *cursor);
	v->w.p.jobs = jobs;
	m->n = list_own(v, least, cursor);
	if (!(m->records = pm_alloc(m->n * stride + 4, sizeof *m->records))) /* 4: records are read as vectors */
		return pm_free(cursor), -PM_DATA;
	for (size_t r = 0; r < v->ranks; r++) {
		for (size_t i = 0; i < v->in[r]; i++, q++) {
			v->place[q] = cursor[tile_of(m, came + q * width) - least]++;
			memcpy(m->records + v->place[q] * stride, came + q * width, width * sizeof *came);
		}
		for (size_t i = 0; i < jobs && r == v->me; i++)
			if (v->own[i].mixed && v->own[i].here) {
				size_t *at = &cursor[v->w.p.job[i].tile - least];
				v->own[i].copy = *at;
				copy(&v->local->order, v->own[i].local, v->own[i].here, width, stride, m->records + *at * stride);
				*at += v->own[i].here;
			}
	}
	memset(m->records + m->n * stride, 0, 4 * sizeof *m->records);
	pm_free(cursor);
	return 0;
}

static int bring(int status, struct pm_shared_jobs *v, size_t width)
{
	const struct pm_tile_order *o = &v->local->order;
	size_t n = status ? 0 : v->sent[0] + o->begin[o->tiles] - v->sent[1];
	double *out = status ? NULL : pm_alloc(n * width + 1, sizeof *out);
	void *came = NULL;
	status = status ? status : out ? 0 : pm_failed();
	if (!status) {
		copy(o, 0, v->sent[0], width, width, out);
		copy(o, v->sent[1], n - v->sent[0], width, width, out + v->sent[0] * width);
		for (size_t r = 0; r < v->ranks; r++)
			v->out[r] *= width * sizeof *out;
	}
	status = pm_world_exchange(status, out, v->out, &came, v->in);
	pm_free(out);
	for (size_t r = 0; r < v->ranks && !status; r++)
		v->out[r] /= width * sizeof *out, v->in[r] /= width * sizeof *out;
	status = status ? status : mix(v, came, width);
	pm_free(came);
	return status;
}

/* The order of the particles here: a gather uses that of the spread before it at the same positions, which may have been used up. */
static int order_of(struct pm_shared_jobs *v, size_t n, const double *const x[], int nvalues, const double *const values[], int room)
{
	const unsigned char *staggered = v->t->staggered[v->w.which[0]];
	struct pm_column at[3], strength[PM_COMPONENTS];
	pm_columns_of(v->t->grid.dim, x, at);
	pm_columns_of(nvalues, values, strength);
	v->local = nvalues ? NULL : pm_order_cache_find(v->t, staggered, n, at);
	for (int c = 0; v->local && c < v->local->order.nvalues; c++)
		v->local->order.values[c] = (struct pm_column){.value = 0}; /* of the spread: nobody asks for them, and their array may be gone */
	if (!v->local || v->local->order.runs.run)
		v->local = pm_order_cache_new(v->t, staggered, n, at, nvalues, strength, room, false);
	else if (pm_tile_order_spent(&v->local->order))
		return pm_tile_order_again(&v->local->order, room);
	return v->local ? 0 : pm_failed();
}

int pm_shared_jobs_of_order(int status, struct pm_shared_jobs *v, int nvalues, int room)
{
	v->ranks = (size_t)pm_world_size(), v->me = (size_t)pm_world_rank();
	v->planes = v->t->planes;
	status = pm_world_agree(status); /* all know the number of tiles */
	if (status)
		return status;
	const struct pm_tile_order *o = &v->local->order;
	const int width = o->dim + nvalues; /* of an order that is kept, records have values on some ranks and are spent on others */
	status = count(status, v);
	status = status ? status : deal(v);
	if (!status)
		records_out(v);
	v->mixed = (struct pm_order_cache){.grid = v->t->grid,
		.order = {.dim = o->dim, .tiles = o->tiles, .stride = width > room ? width : room, .nvalues = nvalues}};
	memcpy(v->mixed.axes, v->local->axes, sizeof v->mixed.axes);
	memcpy(v->mixed.order.across, o->across, sizeof o->across);
	v->mixed.order.axes = v->mixed.axes;
	v->w.o = v->local;
	v->w.p = (struct pm_tile_pass){.grid = &v->t->grid, .order = o, .axes = v->local->axes};
	return bring(status, v, (size_t)width);
}

int pm_shared_jobs_init(int status, struct pm_shared_jobs *v, size_t n, const double *const x[], int nvalues, const double *const values[], int room)
{
	return pm_shared_jobs_of_order(status ? status : order_of(v, n, x, nvalues, values, room), v, nvalues, room);
}

void pm_shared_jobs_free(struct pm_shared_jobs *v, bool keep)
{
	const bool kept = v->local && v->t->kept && *v->t->kept == &v->local->note;
	pm_free(v->mixed.order.records);
	if (keep && !kept)
		pm_order_cache_leave(v->t, v->local);
	else if (!kept)
		pm_order_cache_free(v->local);
	pm_free(v->own), pm_free(v->total), pm_free(v->job), pm_free(v->place);
	free(v->job_of), free(v->holder);
	pm_pass_end(&v->w);
}

struct pm_pass pm_shared_jobs_pass(const struct pm_shared_jobs *v, size_t i)
{
	struct pm_pass w = v->w;
	if (v->own[i].mixed)
		w.o = (struct pm_order_cache *)(uintptr_t)&v->mixed, w.p.order = &v->mixed.order, w.results = NULL;
	return w;
}
