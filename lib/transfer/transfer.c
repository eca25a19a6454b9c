/* Spread and gather by tiles of cells: particles are sorted by tile (tile-order.c), each tile has its own block without faces (transfer-tile.c), and blocks
 * are added to or read from the mesh here, where points beyond a face are folded back with the sign of their image. A point's sum is
 * made of its tiles' sums, in the order of the tiles, each in the order of the stream: the same bytes for any number of threads.
 * Cost: two passes over the particles for the order (none where it is assumed), width^dim products each, a pass over the mesh.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <string.h>

#include "transfer/gather-in-place.h"
#include "transfer/tile-gradient.h"
#include "transfer/tile-line.h"
#include "transfer/tile-plane.h"
#include "transfer/tile-stretches.h"
#include "transfer/tile-vector.h"
#include "transfer/tile-wide.h"
#include "transfer/transfer-pass.h"

struct pm_tile pm_pass_tile(const struct pm_pass *w, const struct pm_tile_job *j, double *block)
{
	struct pm_tile t = {.kernel = w->t->kernel, .shift = w->o->axes[0].shift, .count = j->to - j->from, .stride = w->o->order.stride, .block = block};
	if (w->o->order.records)
		t.records = w->o->order.records + j->from * (size_t)w->o->order.stride;
	const int to = w->to ? w->to : w->components;
	t.results = w->results ? w->results + j->from * (size_t)to : t.records;
	t.to = w->results ? to : t.stride;
	for (int d = 0; d < 3; d++)
		pm_tile_slots(&w->p, j->tile, d, &t.cell[d]);
	return t;
}

static void cells_of(const struct pm_pass *w, const struct pm_tile_job *j, size_t cells[3])
{
	size_t first;
	for (int d = 0; d < 3; d++)
		cells[d] = pm_tile_slots(&w->p, j->tile, d, &first) - (size_t)(w->t->kernel->width - 1);
}

/* The loop over particles straight from the stream; NULL: there is none. */
static pm_tile_spread_loop *spread_straight(int dim, const struct pm_kernel *k, bool squares)
{
	if (squares)
		return !PM_TILE_CIC_EIGHT ? NULL : dim == 1 ? pm_tile_line_spread : pm_tile_cic_spread;
	return pm_tile_has_plane(dim, k) ? pm_tile_plane_spread : pm_tile_spread_wide_batch(dim, k);
}

/* Where particles stand in the stream that stay and come later than p. */
static size_t later(const struct pm_tile_order *o, size_t p) { return pm_tile_runs_at(&o->runs, p + PM_TILE_AHEAD < o->n ? p + PM_TILE_AHEAD : o->n - 1); }

/* Positions of particles that stay and stand apart, to few; or false. */
static bool take_apart(struct pm_tile_batch *b, size_t p, size_t m, double few[3][PM_TILE_ORDER_PACK])
{
	const struct pm_tile_order *o = b->order;
	const struct pm_tile_runs *r = &o->runs;
	const double *from[3];
	double *to[3];
	if (!r->run || pm_tile_runs_together(r, p, m))
		return false;
	for (int d = 0; d < o->dim; d++) {
		if (!o->x[d].doubles)
			return false;
		from[d] = o->x[d].doubles, b->x[d] = to[d] = few[d];
		b->next[d] = from[d] + later(o, p);
	}
	pm_tile_runs_take(r, p, m, o->dim, from, to);
	pm_tile_runs_fetch(r, p + m, PM_TILE_ORDER_PACK, o->dim, from);
	return true;
}

/* Positions of the stream, or, where these are floats or stand apart, copied to few; then m <= PM_TILE_ORDER_PACK. */
static void take(struct pm_tile_batch *b, size_t p, size_t m, double few[3][PM_TILE_ORDER_PACK])
{
	b->p = p, b->m = m;
	if (few && take_apart(b, p, m, few))
		return;
	for (int d = 0; d < b->order->dim; d++) {
		const struct pm_column *x = &b->order->x[d];
		b->x[d] = few ? pm_tile_order_take(b->order, p, m, x, few[d]) : pm_column_take(x, p, m, NULL);
		b->next[d] = b->x[d] + PM_TILE_AHEAD;
	}
}

/* The particles of a job to its block. */
void pm_pass_spread(const struct pm_pass *w, const struct pm_tile_job *j, int value, double *block)
{
	struct pm_tile t = pm_pass_tile(w, j, block);
	const int dim = w->o->order.dim;
	const bool squares = pm_tile_has_squares(dim, w->t->kernel, t.count);
	pm_tile_loop *loop = pm_tile_spread(dim, w->t->kernel, squares);
	pm_tile_spread_loop *straight = w->o->order.floats ? NULL : spread_straight(dim, w->t->kernel, squares);
	double packed[PM_TILE_ORDER_PACK * (PM_COMPONENTS + 3) + 4], few[3][PM_TILE_ORDER_PACK];
	struct pm_tile_batch batch = pm_tile_batch(&w->o->order);
	batch.outside = w->outside;
	t.value = dim + value;
	t.squares = squares ? w->squares + (size_t)omp_get_thread_num() * PM_TILE_SQUARES : NULL;
	if (t.records)
		loop(&t);
	for (size_t p = j->from; p < j->to && !w->o->order.records; p += t.count) {
		t.count = j->to - p < PM_TILE_ORDER_PACK ? j->to - p : PM_TILE_ORDER_PACK;
		if (w->outside && !squares && !pm_tile_order_all_in(&w->o->order, j->tile, p, t.count)) {
			__atomic_store_n(w->outside, true, __ATOMIC_RELAXED);
			return;
		}
		if (straight) {
			const struct pm_column *values = &w->o->order.values[value];
			const double *q = pm_tile_order_take(&w->o->order, p, t.count, values, packed);
			take(&batch, p, t.count, few);
			batch.next_value = q != packed || !values->doubles ? q + PM_TILE_AHEAD : values->doubles + later(&w->o->order, p);
			straight(&t, &batch, q);
			continue;
		}
		t.records = packed;
		pm_tile_order_pack(&w->o->order, p, t.count, true, packed);
		loop(&t);
	}
	if (squares) {
		size_t cells[3];
		cells_of(w, j, cells);
		if (dim == 1)
			pm_tile_line_fold(&t, cells[0]);
		else
			pm_tile_cic_fold(&t, cells);
	}
}

/* Doubles from block to block, whole lines of the cache: those of all threads, in the plane a quarter of the most, are to stay in it. */
static size_t doubles_of_block(int dim)
{
	return ((size_t)pm_block_row[dim] * (size_t)pm_block_rows[dim] * (size_t)pm_block_planes[dim] + 7) / 8 * 8;
}

/* No more than there are jobs, and blocks. */
static int threads_of(const struct pm_pass *w, int threads) { return (size_t)threads < w->p.jobs ? threads : (int)w->p.jobs + !w->p.jobs; }

static struct pm_tile_target mesh_of(const struct pm_pass *w, int value)
{
	const struct pm_axis *a = w->o->axes;
	return (struct pm_tile_target){.axes = {&a[0], &a[1], &a[2]}, .flip = w->t->flip[w->which[value]], .scale = 1 / pm_grid_cell(&w->t->grid)};
}

static void spread_component(const struct pm_pass *w, int value, int threads, const struct pm_tile_stretches *s, double *mesh)
{
	const struct pm_tile_target to_mesh = mesh_of(w, value);
	const bool *const outside = w->outside;
#pragma omp parallel num_threads(threads)
	{
		double *block = w->blocks + (size_t)omp_get_thread_num() * doubles_of_block(w->t->grid.dim);
#pragma omp for schedule(dynamic, 1)
		for (size_t k = 0; k < s->count; k++)
			for (size_t j = s->stretch[k].from, kept = 0; j < s->stretch[k].to && !(outside && __atomic_load_n(outside, __ATOMIC_RELAXED)); j++) {
				pm_tile_fetch_mesh(&w->p, &w->p.job[j], &to_mesh, mesh);
				pm_pass_spread(w, &w->p.job[j], value, block);
				pm_tile_stretch_add(s, k, &w->p, &w->p.job[j], &to_mesh, block, mesh, &kept);
			}
		if (!(outside && *outside)) /* else not all were kept, and the mesh is cleared */
			pm_tile_stretches_add_kept(s, &w->p, &to_mesh, omp_get_thread_num(), omp_get_num_threads(), mesh);
	}
}

void pm_tile_results_few(size_t p, size_t m, int stride, const double *results, int n, const struct pm_tile_results *r, float *few, int to)
{
	for (size_t i = 0; i < m; i++)
		for (int c = 0; c < n; c++)
			few[(p + i) * (size_t)to + (size_t)c] = (float)(r->factor[c].value * results[i * (size_t)stride + (size_t)c]);
}

/* What a batch of an order of floats becomes. */
static bool leave_results(const struct pm_pass *w, size_t p, size_t m, int stride, const double *packed, const struct pm_tile_results *r)
{
	if (w->few)
		pm_tile_results_few(p, m, stride, packed, w->components, r, w->few, w->few_to);
	for (size_t i = 0; i < m && !w->few; i++)
		memcpy(w->results + (p + i) * (size_t)w->components, packed + i * (size_t)stride, (size_t)w->components * sizeof *packed);
	return true;
}

/* Of particles that stay in the stream, in order or by their places, or whose records are floats. t: with the blocks of the job. */
static bool gather_in_order(const struct pm_pass *w, const struct pm_tile_job *j, struct pm_tile t, pm_tile_loop *loop, const struct pm_tile_results *r)
{
	double packed[PM_TILE_ORDER_PACK * (PM_COMPONENTS + 3) + 4];
	struct pm_tile_order o = w->o->order; /* one that was kept may have narrower records than there are values */
	bool finite = true;
	o.stride = o.stride < w->components ? w->components : o.stride;
	t.records = t.results = packed;
	t.to = t.stride = o.stride;
	for (size_t p = j->from; p < j->to; p += t.count) {
		t.count = j->to - p < PM_TILE_ORDER_PACK ? j->to - p : PM_TILE_ORDER_PACK;
		pm_tile_order_pack(&o, p, t.count, false, packed);
		loop(&t);
		if (r->taker) {
			pm_tile_results_hand_over(&w->o->order, p, t.count, t.to, t.results, w->components, r);
			continue;
		}
		finite &= o.floats ? leave_results(w, p, t.count, t.stride, packed, r)
				   : pm_tile_results_deliver(&o, p, t.count, t.stride, packed, w->components, r);
	}
	return finite;
}

/* Of a stream in order, or whose particles have places, straight from it and to it where they stand together; else by way of a batch of doubles. */
static bool gather_batches(const struct pm_pass *w, const struct pm_tile_job *j, const struct pm_tile *t, pm_tile_gather_loop *loop,
	const struct pm_tile_results *r)
{
	const struct pm_tile_order *o = &w->o->order;
	struct pm_tile_batch batch = pm_tile_batch(o);
	double few[3][PM_TILE_ORDER_PACK], values[PM_COMPONENTS][PM_TILE_ORDER_PACK];
	struct pm_column one[PM_COMPONENTS];
	struct pm_target to[PM_COMPONENTS];
	double *value[PM_COMPONENTS], *const places[3] = {few[0], few[1], few[2]};
	bool set[PM_COMPONENTS], finite = true;
	if (!w->blockwise && !o->runs.run && !r->taker) {
		take(&batch, j->from, j->to - j->from, NULL);
		return loop(t, &batch, r);
	}
	for (int c = 0; c < w->components; c++)
		one[c] = (struct pm_column){.value = 1}, set[c] = true, to[c] = (struct pm_target){.doubles = values[c]}, value[c] = values[c];
	const struct pm_column *now = r->most || r->taker ? r->factor : one, *then = r->most ? one : r->factor; /* what is looked at has its factor */
	for (size_t p = j->from; p < j->to; p += PM_TILE_ORDER_PACK) {
		const size_t m = j->to - p < PM_TILE_ORDER_PACK ? j->to - p : PM_TILE_ORDER_PACK;
		take(&batch, p, m, few);
		if (!w->blockwise && !r->taker && pm_tile_runs_together(&o->runs, p, m)) {
			batch.p = pm_tile_runs_at(&o->runs, p);
			finite &= loop(t, &batch, r);
			continue;
		}
		batch.p = 0;
		loop(t, &batch, &(struct pm_tile_results){now, set, to, r->most, NULL});
		if (r->taker)
			r->taker->take(r->taker->data, o, p, m, places, value);
		else
			finite &= pm_tile_results_deliver_arrays(o, p, m, values[0], w->components, &(struct pm_tile_results){then, r->set, r->to, NULL, NULL});
	}
	return finite;
}

static void not_looked_at(const struct pm_tile_results *r)
{
	if (r && r->most)
		*r->most = INFINITY;
}

/* The same of cic, by squares or from the block; with records, whose results are checked later, too. */
static bool gather_cic(const struct pm_pass *w, const struct pm_tile_job *j, struct pm_tile t, const struct pm_tile_results *r)
{
	const size_t each = (size_t)PM_TILE_SQUARES;
	size_t cells[3];
	if (PM_TILE_CIC_SQUARES)
		t.squares = w->squares + (size_t)omp_get_thread_num() * (size_t)w->components * each;
	cells_of(w, j, cells);
	for (int c = 0; c < w->components && PM_TILE_CIC_SQUARES; c++)
		pm_tile_cic_unfold(t.block + (size_t)c * PM_BLOCK_MOST, cells, t.squares + (size_t)c * each);
	if (t.records)
		return pm_tile_cic_gather_eight(&t), true;
	return w->o->order.floats ? gather_in_order(w, j, t, pm_tile_cic_gather_eight, r) : gather_batches(w, j, &t, pm_tile_cic_gather, r);
}

static void make_gradient(const struct pm_pass *w, const struct pm_tile_job *j, double *block, double *nodes)
{
	pm_tile_gradient(w->t->gradient, &w->p, j, block, nodes);
	pm_tile_gradient_fetch(w->t->gradient, &w->p, pm_tile_next(&w->p, j));
}

/* All components at once; with records too. */
static bool gather_vectors(const struct pm_pass *w, const struct pm_tile_job *j, struct pm_tile t, const struct pm_tile_results *r)
{
	pm_tile_loop *loop = pm_tile_gather_vector(w->t->kernel);
	size_t slots[3], first;
	for (int d = 0; d < 3; d++)
		slots[d] = pm_tile_slots(&w->p, j->tile, d, &first);
	const int group = pm_vector_group(w->components);
	t.nodes = w->nodes + (size_t)omp_get_thread_num() * pm_vector_groups(w->components) * PM_VECTOR_NODES;
	double *nodes = t.nodes;
	if (w->t->gradient)
		make_gradient(w, j, NULL, nodes);
	for (int c = 0; c < w->components && !w->t->gradient; c += group, nodes += PM_VECTOR_NODES)
		pm_tile_weave(t.block + (size_t)c * PM_BLOCK_MOST, w->components - c < group ? w->components - c : group, slots, nodes);
	const bool straight = !t.records && loop == pm_tile_cic_gather_vectors && !w->o->order.floats;
	if (!straight)
		not_looked_at(r);
	if (t.records)
		return loop(&t), true;
	if (!straight)
		return gather_in_order(w, j, t, loop, r);
	return gather_batches(w, j, &t, pm_tile_cic_gather_vectors_in_order, r);
}

bool pm_pass_gather(const struct pm_pass *w, const struct pm_tile_job *j, double *block, const struct pm_tile_results *r)
{
	pm_tile_loop *loop = pm_tile_gather(w->o->order.dim, w->t->kernel);
	struct pm_tile t = pm_pass_tile(w, j, block);
	t.components = w->components;
	const bool vectors = w->nodes && pm_tile_has_vectors(w->o->order.dim, w->t->kernel, w->components, t.count);
	if (w->t->gradient && !vectors)
		make_gradient(w, j, block, NULL);
	if (vectors)
		return gather_vectors(w, j, t, r);
	not_looked_at(r);
	const bool squares = pm_tile_has_squares(w->o->order.dim, w->t->kernel, t.count);
	if (squares && w->o->order.dim == 1 && PM_TILE_CIC_EIGHT && !t.records && !w->o->order.floats)
		return gather_batches(w, j, &t, pm_tile_line_gather, r);
	pm_tile_gather_loop *straight = pm_tile_has_plane(w->o->order.dim, w->t->kernel) ? pm_tile_plane_gather
											: pm_tile_gather_wide_batch(w->o->order.dim, w->t->kernel);
	if (straight && !t.records && !w->o->order.floats)
		return gather_batches(w, j, &t, straight, r);
	const bool lanes = PM_TILE_CIC_SQUARES || (PM_TILE_CIC_EIGHT && (t.components == 1 || !t.records)); /* of records, one is worth turning four */
	if (lanes && squares && w->o->order.dim == 3)
		return gather_cic(w, j, t, r);
	if (!t.records)
		return gather_in_order(w, j, t, loop, r);
	loop(&t);
	return true;
}

bool pm_pass_gather_all(const struct pm_pass *w, int threads, const double *const mesh[], const struct pm_tile_results *r)
{
	const struct pm_axis *a = w->p.axes;
	double most = 0;
	int bad = 0;
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1) reduction(| : bad) reduction(max : most)
	for (size_t j = 0; j < w->p.jobs; j++) {
		double here = 0;
		const struct pm_tile_results mine = {r->factor, r->set, r->to, r->most ? &here : NULL, r->taker};
		double *block = w->blocks + (size_t)omp_get_thread_num() * (size_t)w->components * PM_BLOCK_MOST;
		for (int c = 0; c < w->components && !w->t->gradient; c++) {
			const struct pm_tile_target from = {.axes = {&a[0], &a[1], &a[2]}, .flip = w->t->flip[w->which[c]]};
			pm_tile_load_block(&w->p, &w->p.job[j], &from, mesh[w->which[c]], block + (size_t)c * PM_BLOCK_MOST);
			pm_tile_fetch_mesh(&w->p, pm_tile_next(&w->p, &w->p.job[j]), &from, mesh[w->which[c]]);
		}
		bad |= !pm_pass_gather(w, &w->p.job[j], block, &mine);
		most = here > most ? here : most;
	}
	if (r->most)
		*r->most = most;
	return !bad;
}

/* The next pass: the first component not yet done, and all with the same offset. False if there is none. */
bool pm_pass_next(const struct pm_transfer *t, bool done[], struct pm_pass *w)
{
	*w = (struct pm_pass){.t = t};
	for (int c = 0; c < t->components; c++)
		if (!done[c] && (!w->components || !memcmp(t->staggered[c], t->staggered[w->which[0]], sizeof t->staggered[c]))) {
			done[c] = true;
			w->which[w->components++] = c;
		}
	return w->components > 0;
}

/* Blocks for at most `at_once` jobs, of so many doubles each. */
static int begin_pass(struct pm_pass *w, size_t at_once, size_t doubles)
{
	int status = w->o ? pm_tile_pass_init(&w->p, &w->t->grid, &w->o->order, w->o->axes) : -PM_DATA;
	at_once = at_once < w->p.jobs ? at_once : w->p.jobs;
	w->blocks = status ? NULL : pm_zalloc(at_once * doubles, sizeof *w->blocks);
	return w->blocks ? 0 : -PM_DATA;
}

/* The particles in order, with the values that go along. */
static int begin_spread(struct pm_pass *w, size_t n, const struct pm_column x[], const struct pm_column strength[], int threads, bool assume)
{
	struct pm_column values[PM_COMPONENTS];
	for (int c = 0; c < w->components; c++)
		values[c] = strength[w->which[c]];
	w->o = pm_order_cache_new(w->t, w->t->staggered[w->which[0]], n, x, w->components, values, 0, assume);
	return begin_pass(w, (size_t)threads, doubles_of_block(w->t->grid.dim));
}

int pm_pass_squares(struct pm_pass *w, int threads, int each)
{
	bool used = false;
	for (size_t j = 0; j < w->p.jobs && !used; j++)
		used = pm_tile_has_squares(w->o->order.dim, w->t->kernel, w->p.job[j].to - w->p.job[j].from);
	if (used)
		w->squares = pm_zalloc((size_t)threads * (size_t)each * PM_TILE_SQUARES, sizeof *w->squares);
	return used && !w->squares ? -PM_DATA : 0;
}

int pm_pass_vectors(struct pm_pass *w, int threads)
{
	for (size_t j = 0; j < w->p.jobs && !w->nodes; j++)
		if (pm_tile_has_vectors(w->o->order.dim, w->t->kernel, w->components, w->p.job[j].to - w->p.job[j].from)) {
			w->nodes = pm_alloc((size_t)threads * pm_vector_groups(w->components) * PM_VECTOR_NODES, sizeof *w->nodes);
			return w->nodes ? 0 : -PM_DATA;
		}
	return PM_TILE_CIC_SQUARES && w->o->order.dim == 3 ? pm_pass_squares(w, threads, w->components) : 0;
}

/* Results go into the records where they have room, of a kept order too: mostly nothing else is gathered at these positions, and if it is, the records are
 * moved again. They would be 24 bytes a particle, at the peak of a step. */
static int begin_gather(struct pm_pass *w, size_t n, const struct pm_column x[], const struct pm_tile_results *r, int threads)
{
	const unsigned char *staggered = w->t->staggered[w->which[0]];
	w->o = pm_order_cache_find(w->t, staggered, n, x);
	if (!w->o)
		w->o = pm_order_cache_new(w->t, staggered, n, x, 0, NULL, w->components, false);
	else if (pm_tile_order_spent(&w->o->order) && pm_tile_order_again(&w->o->order, w->components))
		return -PM_DATA;
	struct pm_tile_order *o = w->o ? &w->o->order : NULL;
	const bool records = o && o->records;
	for (int c = 0; c < w->components && o; c++)
		w->blockwise |= o->columns || o->floats || r->to[c].floats || r->factor[c].floats;
	if (o && o->floats && pm_tile_results_round(w->components, r)) {
		w->few_to = w->components > o->packed ? w->components : o->packed;
		w->few = w->components > o->packed ? pm_alloc(n * (size_t)w->few_to, sizeof *w->few) : o->floats;
		if (!w->few)
			return -PM_DATA;
	} else if (o && o->floats && !(w->results = pm_alloc(n * (size_t)w->components, sizeof *w->results)))
		return -PM_DATA;
	if (records && w->components > w->o->order.stride && !(w->results = pm_alloc(n * (size_t)w->components, sizeof *w->results)))
		return -PM_DATA;
	int status = begin_pass(w, (size_t)threads, (size_t)w->components * PM_BLOCK_MOST);
	return status || !PM_TILE_CIC_EIGHT ? status : pm_pass_vectors(w, threads);
}

void pm_pass_end(struct pm_pass *w)
{
	pm_free(w->nodes);
	pm_free(w->squares);
	pm_free(w->blocks);
	pm_tile_pass_free(&w->p);
	pm_free(w->results);
	if (w->few && (!w->o || w->few != w->o->order.floats))
		pm_free(w->few);
}

void pm_columns_of(int n, const double *const x[], struct pm_column to[])
{
	for (int c = 0; c < n; c++)
		to[c] = pm_column_doubles(x[c]);
}

static void doubles_of(int n, const struct pm_column from[], const double *to[])
{
	for (int c = 0; c < n; c++)
		to[c] = from[c].doubles;
}

/* Threads worth waking: each has what takes 0.2 ms. */
static int threads_for(const struct pm_transfer *t, size_t n)
{
	const size_t width = t->kernel->width > 2 ? (size_t)t->kernel->width : 2, most = n * width * width / pm_many_turns();
	return most < 2 ? 1 : (size_t)pm_threads() < most ? pm_threads() : (int)most;
}

int pm_spread(const struct pm_transfer *t, size_t n, const double *const x[], const double *const strength[], double *const mesh[],
	struct pm_strays *strays)
{
	struct pm_column at[3], values[PM_COMPONENTS];
	pm_columns_of(t->grid.dim, x, at);
	pm_columns_of(t->components, strength, values);
	return pm_spread_columns(t, n, at, values, mesh, strays);
}

/* Of the loops only that over squares looks whether particles are in their tile. */
static bool may_assume(const struct pm_transfer *t)
{
	return t->cleared && t->grid.dim == 3 && t->components == 1 && spread_straight(3, t->kernel, true) == pm_tile_cic_spread;
}

int pm_spread_columns(const struct pm_transfer *t, size_t n, const struct pm_column x[], const struct pm_column strength[], double *const mesh[],
	struct pm_strays *strays)
{
	bool done[PM_COMPONENTS] = {false}, assume = true, outside = false;
	struct pm_pass w;
	int status = 0, threads = threads_for(t, n);
	*strays = (struct pm_strays){.count = 0};
	if (t->planes && t->planes->divided) {
		const double *at[3], *values[PM_COMPONENTS];
		doubles_of(t->grid.dim, x, at), doubles_of(t->components, strength, values);
		return pm_spread_ranks(t, n, at, values, mesh, strays);
	}
	while (n && !status && pm_pass_next(t, done, &w)) {
		status = begin_spread(&w, n, x, strength, threads, assume && may_assume(t));
		if (!status && w.o->order.assumed)
			w.outside = &outside;
		struct pm_tile_stretches s = {.count = 0};
		status = status ? status : pm_pass_squares(&w, threads, 1);
		if (!status) {
			const struct pm_tile_target lines = mesh_of(&w, 0);
			status = pm_tile_stretches_init(&s, &w.p, &lines, threads_of(&w, threads));
		}
		for (int c = 0; c < w.components && !status; c++)
			spread_component(&w, c, threads_of(&w, threads), &s, mesh[w.which[c]]);
		pm_tile_stretches_free(&s);
		if (!status)
			*strays = w.o->strays;
		pm_pass_end(&w);
		if (outside) {
			pm_order_cache_free(w.o);
			memset(mesh[0], 0, pm_grid_size(&t->grid) * sizeof *mesh[0]);
			assume = outside = done[0] = false;
			continue;
		}
		pm_order_cache_leave(t, w.o);
	}
	return status;
}

int pm_gather(const struct pm_transfer *t, size_t n, const double *const x[], const double *const mesh[], const double *const factor[],
	double *const out[], struct pm_strays *strays)
{
	struct pm_column at[3], times[PM_COMPONENTS];
	struct pm_target to[PM_COMPONENTS];
	pm_columns_of(t->grid.dim, x, at);
	for (int c = 0; c < t->components; c++) {
		times[c] = (struct pm_column){.doubles = factor ? factor[c] : NULL, .value = 1};
		to[c] = (struct pm_target){.doubles = out[c]};
	}
	return pm_gather_columns(t, n, at, mesh, times, to, strays);
}

static int gather_ranks(const struct pm_transfer *t, size_t n, const struct pm_column x[], const double *const mesh[], const struct pm_column factor[],
	const struct pm_target out[], struct pm_strays *strays)
{
	const double *at[3], *times[PM_COMPONENTS];
	double *to[PM_COMPONENTS];
	doubles_of(t->grid.dim, x, at), doubles_of(t->components, factor, times);
	for (int c = 0; c < t->components; c++)
		to[c] = out[c].doubles;
	return pm_gather_ranks(t, n, at, mesh, times, to, strays);
}

int pm_gather_columns(const struct pm_transfer *t, size_t n, const struct pm_column x[], const double *const mesh[], const struct pm_column factor[],
	const struct pm_target out[], struct pm_strays *strays)
{
	bool done[PM_COMPONENTS] = {false}, finite = true;
	struct pm_pass w;
	double most = 0;
	int status = 0, threads = threads_for(t, n);
	*strays = (struct pm_strays){.count = 0};
	if (t->planes && t->planes->divided)
		return gather_ranks(t, n, x, mesh, factor, out, strays);
	bool staggered = t->lower;
	for (int c = 1; c < t->components; c++)
		staggered = staggered || (!t->kernel->star && memcmp(t->staggered[c], t->staggered[0], sizeof t->staggered[c]));
	if (n && staggered)
		return pm_gather_staggered(t, n, x, mesh, factor, out, strays);
	while (n && !status && pm_pass_next(t, done, &w)) {
		struct pm_target to[PM_COMPONENTS];
		struct pm_column times[PM_COMPONENTS];
		bool set[PM_COMPONENTS], look = w.components == 3 && t->components == 3;
		for (int c = 0; c < w.components; c++) {
			set[c] = t->set[w.which[c]];
			to[c] = out[w.which[c]];
			times[c] = factor[w.which[c]];
			look = look && set[c] && to[c].doubles && !times[c].doubles && !times[c].floats;
		}
		const struct pm_tile_results r = {times, set, to, look ? &most : NULL, NULL};
		status = begin_gather(&w, n, x, &r, threads);
		bool seen = !status && pm_pass_gather_all(&w, threads_of(&w, threads), mesh, &r);
		const struct pm_tile_order *o = status ? NULL : &w.o->order;
		if (o && w.few)
			status = pm_tile_results_return_floats(o, w.few, w.few_to, w.components, &r);
		else if (o && (o->records || o->floats))
			status = pm_tile_results_return(o, w.results ? w.results : o->records, w.results ? w.components : o->stride, w.components, &r, &seen);
		finite = finite && seen;
		if (o)
			pm_tile_results_leave_strays(o, w.components, &r);
		if (!status)
			*strays = w.o->strays;
		bool in_use = w.o && t->kept && *t->kept == &w.o->note;
		const bool used_up = in_use && !w.results && (!w.few || w.few == w.o->order.floats);
		if (used_up && w.few)
			w.few = NULL;
		if (used_up)
			pm_tile_order_spend(&w.o->order);
		pm_pass_end(&w);
		if (!in_use)
			pm_order_cache_free(w.o);
	}
	strays->finite = finite;
	strays->most = isfinite(most) ? most : 0;
	return status;
}

int pm_gather_taken(const struct pm_transfer *t, size_t n, const struct pm_column x[], const double *const mesh[], double factor,
	const struct pm_tile_taker *taker)
{
	bool done[PM_COMPONENTS] = {false};
	const int threads = threads_for(t, n);
	struct pm_pass w;
	const struct pm_order_cache *o = pm_order_cache_find(t, t->staggered[0], n, x);
	bool in_place = false;
	int status = o ? pm_gather_in_place(t, o, factor, taker, threads, &in_place) : 0;
	if (status || in_place)
		return status;
	const struct pm_target to[PM_COMPONENTS] = {{.doubles = NULL}};
	struct pm_column times[PM_COMPONENTS];
	for (int c = 0; c < t->components; c++)
		times[c] = (struct pm_column){.value = factor};
	const struct pm_tile_results r = {times, t->set, to, NULL, taker};
	pm_pass_next(t, done, &w);
	status = begin_gather(&w, n, x, &r, threads);
	bool finite = !status && pm_pass_gather_all(&w, threads_of(&w, threads), mesh, &r);
	if (!status && w.o->order.records)
		status = pm_tile_results_return(&w.o->order, w.results ? w.results : w.o->order.records, w.results ? w.components : w.o->order.stride,
			w.components, &r, &finite);
	if (w.o && w.o->order.records)
		pm_tile_order_spend(&w.o->order);
	pm_pass_end(&w);
	if (!o)
		pm_order_cache_free(w.o);
	return status;
}

/* Cells missing below and above on one axis. floor + 1: one cell to spare against rounding. */
static int grow_axis(const struct pm_grid *g, int d, double r, size_t n, const double *x, double *below, double *above)
{
	double least = INFINITY, most = -INFINITY, cells = (double)g->cells[d];
	*below = *above = 0;
	if (g->face[d][0] == PM_PERIODIC)
		return 0;
	for (size_t p = 0; p < n; p++) {
		double s = (x[p] - g->lo[d]) / g->h[d];
		least = fmin(least, s);
		most = fmax(most, s);
	}
	*below = least < r ? floor(r - least) + 1 : 0;
	*above = most > cells - r ? floor(most - (cells - r)) + 1 : 0;
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
