/* Gather of components at several offsets, as those of E and B on Yee's mesh, in one pass over the particles in their order among the nodes (staggered-tile.c).
 * A point half a cell up is looked for in the particle's own cell of halves and the next (transfer-axis.h), so a tile has one slot more of them; what is
 * gathered for a particle does not depend on the order, so ranks may sort for every offset and get the same bytes (transfer-ranks.c). A thread keeps the
 * blocks of its tile from job to job, and where there are many particles its nodes (staggered-nodes.c). Cost: one sort, or a reading of positions where the
 * particles are nearly in order; width^dim products a component. SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <string.h>

#include "transfer/gather-staggered.h"
#include "transfer/staggered-nodes.h"
#include "transfer/transfer-pass.h"

/* What all jobs have in common. */
struct staggered {
	const struct pm_transfer *t;
	struct pm_axis nodes[3], axes[PM_COMPONENTS][3]; /* of the order; of each component, with the cells of the nodes */
	struct pm_tile_order own;
	const struct pm_tile_order *o; /* own, or the one that was left */
	struct pm_tile_order *left;    /* that one; NULL */
	struct pm_strays strays;
	struct pm_tile_pass pass;
	double *blocks;  /* [threads][components][PM_BLOCK_MOST] */
	double *woven;   /* [threads][PM_STAGGERED_NODES], or NULL */
	double *results; /* where there are records: [n][components] */
	float *few;      /* the same of records of floats, rounded; NULL */
	struct pm_tile_results to;
};

/* The order among the nodes, as the density left it or made anew. */
static int find_order(struct staggered *s, size_t n, const struct pm_column x[])
{
	const unsigned char nodes[3] = {0, 0, 0};
	struct pm_order_cache *left = pm_order_cache_find(s->t, nodes, n, x);
	const struct pm_tile_particles particles = {.dim = s->t->grid.dim, .n = n, .x = x, .stays = PM_STAY_WIDE};
	int status = pm_axes_init(s->nodes, s->t, nodes);
	if (left && pm_tile_order_spent(&left->order))
		status = status ? status : pm_tile_order_again(&left->order, 0);
	if (left)
		s->strays = left->strays;
	else
		status = status ? status : pm_tile_order_init(&s->own, s->nodes, &particles, 0, &s->strays);
	s->left = left ? &left->order : NULL;
	s->o = left ? s->left : &s->own;
	s->few = !status && s->o->floats && pm_tile_results_round(s->t->components, &s->to) ? pm_alloc(n * (size_t)s->t->components, sizeof *s->few) : NULL;
	if (!status && (s->o->records || (s->o->floats && !s->few)) && !(s->results = pm_alloc(n * (size_t)s->t->components, sizeof *s->results)))
		status = -PM_DATA;
	return status;
}

static int find_axes(struct staggered *s)
{
	int status = pm_tile_pass_init(&s->pass, &s->t->grid, s->o, s->nodes);
	for (int c = 0; c < s->t->components && !status; c++) {
		status = pm_axes_init(s->axes[c], s->t, s->t->staggered[c]);
		for (int d = 0; d < 3 && !status; d++)
			s->axes[c][d].count = s->nodes[d].count;
	}
	return status;
}

/* The blocks of all components of a job's tile. */
static void load_blocks(const struct staggered *s, const struct pm_tile_job *j, const double *const mesh[], double *block)
{
	for (int c = 0; c < s->t->components; c++) {
		const struct pm_axis *a = s->axes[c];
		struct pm_tile_pass p = s->pass;
		p.axes = a;
		pm_tile_load_block(&p, j, &(struct pm_tile_target){.axes = {&a[0], &a[1], &a[2]}, .flip = s->t->flip[c]}, mesh[c],
			block + (size_t)c * PM_BLOCK_MOST);
	}
}

/* Particles p..p+m-1 of the order, whose values are arrays: to the results, or, true if finite, to the particles. */
static bool put_arrays(const struct staggered *s, size_t p, size_t m, const double *values)
{
	const struct pm_tile_order *o = s->o;
	const int components = s->t->components;
	if (!s->few && !s->results)
		return pm_tile_results_deliver_arrays(o, p, m, values, components, &s->to);
	double results[PM_TILE_ORDER_PACK * PM_COMPONENTS], *to = s->few ? results : s->results + p * (size_t)components;
	for (size_t i = 0; i < m; i++)
		for (int c = 0; c < components; c++)
			to[i * (size_t)components + (size_t)c] = values[c * PM_TILE_ORDER_PACK + (int)i];
	if (s->few)
		pm_tile_results_few(p, m, components, results, components, &s->to, s->few, components);
	return true;
}

/* A job from nodes. */
static bool gather_nodes(const struct staggered *s, const struct pm_tile_job *j, struct pm_staggered_tile t)
{
	double u[3][PM_TILE_ORDER_PACK], values[PM_COMPONENTS * PM_TILE_ORDER_PACK];
	pm_staggered_loop *loop = pm_staggered_gather_nodes(s->o->dim, t.kernel, t.lower);
	bool finite = true;
	t.results = values;
	for (int d = 0; d < 3; d++)
		t.u[d] = u[d];
	for (size_t p = j->from; p < j->to; p += t.count) {
		t.count = j->to - p < PM_TILE_ORDER_PACK ? j->to - p : PM_TILE_ORDER_PACK;
		pm_tile_order_columns(s->o, p, t.count, false, (double *[]){u[0], u[1], u[2]});
		loop(&t);
		finite &= put_arrays(s, p, t.count, values);
	}
	return finite;
}

/* A job: to the results of the records, or, true if finite, to the particles. */
static bool gather_job(const struct staggered *s, const struct pm_tile_job *j, struct pm_staggered_tile t)
{
	const struct pm_tile_order *o = s->o;
	const size_t components = (size_t)s->t->components;
	double packed[PM_TILE_ORDER_PACK * 3], values[PM_TILE_ORDER_PACK * PM_COMPONENTS];
	pm_staggered_loop *loop = pm_staggered_gather(o->dim, t.kernel, t.lower, t.components, t.staggered);
	struct pm_tile_order positions = *o;
	bool finite = true;
	if (o->records) {
		t.stride = o->stride;
		t.count = j->to - j->from;
		t.records = o->records + j->from * (size_t)o->stride;
		t.results = s->results + j->from * components;
		return loop(&t), true;
	}
	positions.stride = t.stride = o->dim; /* that of a density has room for strengths */
	t.records = packed, t.results = values;
	for (size_t p = j->from; p < j->to; p += t.count) {
		t.count = j->to - p < PM_TILE_ORDER_PACK ? j->to - p : PM_TILE_ORDER_PACK;
		pm_tile_order_pack(&positions, p, t.count, false, packed);
		loop(&t);
		if (s->few)
			pm_tile_results_few(p, t.count, t.components, values, t.components, &s->to, s->few, t.components);
		else if (s->results)
			memcpy(s->results + p * components, values, t.count * components * sizeof *values);
		else
			finite &= pm_tile_results_deliver(o, p, t.count, t.components, values, t.components, &s->to);
	}
	return finite;
}

/* What a thread has of a tile. */
struct loaded {
	size_t tile;
	double *block, *nodes;
	bool woven;
};

/* A job, whose tile is loaded if it is not yet. */
static struct pm_staggered_tile load_tile(const struct staggered *s, const struct pm_tile_job *j, const double *const mesh[], struct loaded *l)
{
	struct pm_staggered_tile t = {.kernel = s->t->kernel, .lower = s->t->lower, .shift = s->nodes[0].shift, .components = s->t->components,
		.staggered = s->t->staggered, .block = l->block, .nodes = l->nodes};
	size_t slots[3] = {1, 1, 1};
	for (int d = 0; d < 3; d++)
		slots[d] = pm_tile_slots(&s->pass, j->tile, d, &t.cell[d]) + (d < s->o->dim);
	if (l->tile != j->tile) {
		load_blocks(s, j, mesh, l->block);
		l->woven = l->nodes && s->o->begin[j->tile + 1] - s->o->begin[j->tile] >= pm_staggered_worth_nodes(slots);
		if (l->woven)
			pm_staggered_weave(s->o->dim, t.kernel, t.lower, l->block, slots, l->nodes);
		l->tile = j->tile;
	}
	return t;
}

static bool gather_tile(const struct staggered *s, const struct pm_tile_job *j, const double *const mesh[], struct loaded *l)
{
	const struct pm_staggered_tile t = load_tile(s, j, mesh, l);
	return l->woven ? gather_nodes(s, j, t) : gather_job(s, j, t);
}

/* Blocks and nodes of the threads. */
static int make_room(struct staggered *s, size_t n, int threads)
{
	const bool nodes = pm_staggered_has_nodes(s->t->grid.dim, s->t->kernel, s->t->components, s->t->staggered) && n >= PM_TILE_PIECE;
	s->blocks = pm_zalloc((size_t)threads * (size_t)s->t->components * PM_BLOCK_MOST, sizeof *s->blocks);
	s->woven = nodes && s->blocks ? pm_alloc((size_t)threads * PM_STAGGERED_NODES, sizeof *s->woven) : NULL;
	return s->blocks && (s->woven || !nodes) ? 0 : -PM_DATA;
}

static struct loaded nothing_loaded(const struct staggered *s, int thread)
{
	const size_t me = (size_t)thread;
	return (struct loaded){.tile = SIZE_MAX, .block = s->blocks + me * (size_t)s->t->components * PM_BLOCK_MOST,
		.nodes = s->woven ? s->woven + me * PM_STAGGERED_NODES : NULL};
}

static int gather_all(struct staggered *s, size_t n, const double *const mesh[], bool *finite)
{
	const int most = pm_tile_threads(n), threads = (size_t)most < s->pass.jobs ? most : (int)s->pass.jobs + !s->pass.jobs;
	int bad = 0;
	if (make_room(s, n, threads))
		return -PM_DATA;
#pragma omp parallel num_threads(threads) reduction(| : bad)
	{
		struct loaded l = nothing_loaded(s, omp_get_thread_num());
#pragma omp for schedule(dynamic, 1)
		for (size_t j = 0; j < s->pass.jobs; j++)
			bad |= !gather_tile(s, &s->pass.job[j], mesh, &l);
	}
	*finite = !bad;
	return 0;
}

static void give_back(struct staggered *s)
{
	pm_free(s->results), pm_free(s->few), pm_free(s->blocks), pm_free(s->woven);
	pm_tile_pass_free(&s->pass);
	pm_tile_order_free(&s->own);
	pm_axes_free(s->nodes);
	for (int c = 0; c < s->t->components; c++)
		pm_axes_free(s->axes[c]);
}

int pm_gather_staggered(const struct pm_transfer *t, size_t n, const struct pm_column x[], const double *const mesh[], const struct pm_column factor[],
	const struct pm_target out[], struct pm_strays *strays)
{
	struct staggered s = {.t = t};
	bool finite = true;
	s.to = (struct pm_tile_results){.factor = factor, .set = t->set, .to = out};
	int status = find_order(&s, n, x);
	status = status ? status : find_axes(&s);
	status = status ? status : gather_all(&s, n, mesh, &finite);
	if (!status && s.few)
		status = pm_tile_results_return_floats(s.o, s.few, t->components, t->components, &s.to);
	else if (!status && s.results)
		status = pm_tile_results_return(s.o, s.results, t->components, t->components, &s.to, &finite);
	if (!status) {
		pm_tile_results_leave_strays(s.o, t->components, &s.to);
		*strays = s.strays;
		strays->finite = finite;
	}
	if (s.left)
		pm_tile_order_spend(s.left);
	give_back(&s);
	return status;
}

/* ---- a few at a time ---- */

int pm_staggered_order(const struct pm_transfer *t, size_t n, const struct pm_column x[])
{
	const unsigned char nodes[3] = {0, 0, 0};
	struct pm_order_cache *left = pm_order_cache_find(t, nodes, n, x);
	if (!t->kept)
		return 0;
	if (!left) {
		if (!(left = pm_order_cache_new(t, nodes, n, x, 0, NULL, 0, false)))
			return -PM_DATA;
		pm_order_cache_leave(t, left);
	}
	return pm_order_cache_stays(left);
}

struct pm_staggered_few {
	struct pm_transfer t;
	struct staggered s;
	const double *mesh[PM_COMPONENTS];
	struct loaded *loaded; /* [threads] */
};

int pm_staggered_few_new(struct pm_staggered_few **to, const struct pm_transfer *t, const struct pm_tile_order *o, const double *const mesh[], int threads)
{
	const unsigned char nodes[3] = {0, 0, 0};
	struct pm_staggered_few *f = *to = pm_zalloc(1, sizeof *f);
	if (!f || !(f->loaded = pm_alloc((size_t)threads, sizeof *f->loaded)))
		return -PM_DATA;
	f->t = *t;
	f->s.t = &f->t, f->s.o = o;
	memcpy(f->mesh, mesh, (size_t)t->components * sizeof *mesh);
	int status = pm_axes_init(f->s.nodes, &f->t, nodes);
	status = status ? status : find_axes(&f->s);
	status = status ? status : make_room(&f->s, o->n, threads);
	for (int i = 0; i < threads && !status; i++)
		f->loaded[i] = nothing_loaded(&f->s, i);
	return status;
}

void pm_staggered_few(struct pm_staggered_few *f, const struct pm_tile_job *j, size_t m, const double *const u[3], double *values)
{
	struct loaded *l = &f->loaded[omp_get_thread_num()];
	struct pm_staggered_tile t = load_tile(&f->s, j, f->mesh, l);
	const int dim = f->t.grid.dim;
	double packed[PM_TILE_ORDER_PACK * 3], rows[PM_TILE_ORDER_PACK * PM_COMPONENTS];
	t.count = m;
	if (l->woven) {
		for (int d = 0; d < 3; d++)
			t.u[d] = u[d];
		t.results = values;
		pm_staggered_gather_nodes(dim, t.kernel, t.lower)(&t);
		return;
	}
	for (size_t i = 0; i < m; i++)
		for (int d = 0; d < dim; d++)
			packed[i * (size_t)dim + (size_t)d] = u[d][i];
	t.stride = dim, t.records = packed, t.results = rows;
	pm_staggered_gather(dim, t.kernel, t.lower, t.components, t.staggered)(&t);
	for (size_t i = 0; i < m; i++)
		for (int c = 0; c < t.components; c++)
			values[(size_t)c * PM_TILE_ORDER_PACK + i] = rows[i * (size_t)t.components + (size_t)c];
}

void pm_staggered_few_free(struct pm_staggered_few *f)
{
	if (!f)
		return;
	pm_free(f->loaded);
	if (f->s.t)
		give_back(&f->s);
	pm_free(f);
}
