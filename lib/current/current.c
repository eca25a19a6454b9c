/* The current of particles: Esirkepov's by tiles (current-tile.c), of ways cut at the faces of the box (current-ways.c); or the plain product q v W at the
 * middle of the way, which does not keep charge and is there to compare. Villasenor and Buneman's is Esirkepov's for cic with ways cut at the faces of cells:
 * within a cell both are the same. Source: Esirkepov 2001; Villasenor and Buneman 1992; Birdsall and Langdon 1985, section 15-6.
 * Cost: one pass over the particles to find the ways, one sort, 3 (width + 1)^dim products each. SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <string.h>

#include "mesh/particle-faces.h"
#include "current/current-parts.h"
#include "current/current-tile.h"
#include "world/world.h"

const char *const pm_deposit_names[] = {"esirkepov", "villasenor-buneman", "direct", NULL};

int pm_current_check(const struct pm_current *c)
{
	if (c->deposit == PM_VILLASENOR_BUNEMAN && strcmp(c->kernel->name, "cic"))
		return pm_fail(PM_USAGE, "--deposit villasenor-buneman is made for the kernel cic, not %s (--deposit esirkepov takes every kernel)",
			c->kernel->name);
	for (int d = 0; d < c->grid.dim; d++)
		for (int s = 0; s < 2; s++) {
			const enum pm_face f = c->grid.face[d][s];
			const enum pm_particle_face p = c->face[d][s];
			if (f == PM_NEUMANN && p == PM_PABSORB)
				return pm_fail(PM_DATA, "particles absorbed at a neumann face of axis %c would leave their image behind (a wall or an "
					"open face, or reflect them)", "xyz"[d]);
			if ((f == PM_WALL || f == PM_NEUMANN) && p == PM_POPEN)
				return pm_fail(PM_DATA, "particles pass the %s face of axis %c, beyond which there is no mesh (reflect or absorb them: "
					"smod --particle-faces)", pm_face_names[f], "xyz"[d]);
		}
	return 0;
}

/* The components of every block. */
struct spread {
	const struct pm_tile_pass *pass;
	const struct pm_current *c;
	const struct pm_axis *nodes, *halves;
	const bool *rests; /* of pm_current_fill */
	double *blocks; /* [jobs under way][3][PM_BLOCK_MOST] */
	struct pm_current_cells *cells; /* [threads], or NULL */
};

/* What the charges carry along the axes above dim, where the values of an order are velocities. */
static void carry(const bool rests[3], struct pm_current_cells *cells)
{
	for (int d = cells->dim; d < 3; d++)
		for (size_t i = 0; i < cells->count; i++)
			cells->along[d - cells->dim][i] = rests[d] ? 0 : cells->q[i] * cells->along[d - cells->dim][i];
}

/* A job by sums of cells; the ways that have none as records, and all that are left where most have none. */
static void fill_cells(const struct pm_current_fill *s, const struct pm_tile_order *o, const struct pm_tile_job *j, struct pm_current_tile *t,
	struct pm_current_cells *cells)
{
	enum { most_numbers = 7 };
	double *columns[most_numbers], records[PM_TILE_ORDER_PACK * most_numbers + 4];
	int numbers = 0;
	uint32_t others[PM_TILE_ORDER_PACK];
	pm_current_loop *loop = pm_current_deposit(o->dim, t->kernel);
	struct pm_current_tile few = *t;
	bool most = false;
	for (int d = 0; d < o->dim; d++)
		columns[d] = cells->u[d], columns[o->dim + d] = cells->way[d];
	numbers = 2 * o->dim, columns[numbers++] = cells->q;
	for (int d = o->dim; d < 3; d++)
		columns[numbers++] = cells->along[d - o->dim];
	few.stride = numbers, few.records = records;
	memcpy(cells->cell, t->cell, sizeof cells->cell);
	for (size_t at = j->from; at < j->to; at += cells->count) {
		cells->count = j->to - at < PM_TILE_ORDER_PACK ? j->to - at : PM_TILE_ORDER_PACK;
		if (s->c->few) {
			s->c->few->make(s->c->few->data, o, j, at, cells->count, columns, columns + o->dim);
			pm_tile_order_values(o, at, cells->count, columns + 2 * o->dim);
		} else
			pm_tile_order_columns(o, at, cells->count, true, columns);
		if (s->rests)
			carry(s->rests, cells);
		few.count = most ? cells->count : pm_current_cells_add(cells, others);
		for (size_t i = 0; i < few.count; i++)
			for (int c = 0; c < numbers; c++)
				records[i * (size_t)numbers + (size_t)c] = columns[c][most ? i : others[i]];
		most = 2 * few.count > cells->count;
		loop(&few);
	}
	pm_current_cells_fold(cells, t->block);
}

void pm_current_fill(const struct pm_current_fill *s, const struct pm_tile_pass *p, const struct pm_tile_job *j, double *block,
	struct pm_current_cells *cells)
{
	const struct pm_tile_order *o = p->order;
	struct pm_current_tile t = {.kernel = s->c->kernel, .shift = s->shift, .stride = o->stride,
		.block = {block, block + PM_BLOCK_MOST, block + 2 * PM_BLOCK_MOST}};
	pm_current_loop *loop = pm_current_deposit(o->dim, s->c->kernel);
	double packed[PM_TILE_ORDER_PACK * (PM_COMPONENTS + 3) + 4], few[6][PM_TILE_ORDER_PACK];
	for (int d = 0; d < 3; d++)
		pm_tile_slots(p, j->tile, d, &t.cell[d]);
	if (cells && j->to - j->from >= pm_current_cells_least(s->c->kernel)) {
		fill_cells(s, o, j, &t, cells);
		return;
	}
	if (o->records) {
		t.records = o->records + j->from * (size_t)o->stride;
		t.count = j->to - j->from;
		loop(&t);
		return;
	}
	t.records = packed;
	for (size_t at = j->from; at < j->to; at += t.count) {
		t.count = j->to - at < PM_TILE_ORDER_PACK ? j->to - at : PM_TILE_ORDER_PACK;
		if (s->c->few)
			s->c->few->make(s->c->few->data, o, j, at, t.count, (double *[]){few[0], few[1], few[2]}, (double *[]){few[3], few[4], few[5]});
		pm_tile_order_pack(o, at, t.count, true, packed);
		for (size_t i = 0; i < t.count && s->rests; i++)
			for (int d = o->dim; d < 3; d++) {
				double *record = packed + i * (size_t)t.stride + o->dim;
				record[1 + d] = s->rests[d] ? 0 : record[o->dim] * record[1 + d];
			}
		loop(&t);
	}
}

struct pm_tile_target pm_current_target(const struct pm_current *c, const struct pm_axis nodes[3], const struct pm_axis halves[3], int component,
	unsigned char flip[3])
{
	const struct pm_grid *g = &c->grid;
	struct pm_tile_target t = {.flip = flip, .scale = 1 / pm_grid_cell(g)};
	for (int d = 0; d < 3; d++) {
		t.axes[d] = d == component && d < g->dim ? &halves[d] : &nodes[d];
		flip[d] = d == component; /* at a wall the current along it has the opposite image, that through it the same */
	}
	if (component < g->dim)
		t.scale *= g->h[component] / c->dt;
	return t;
}

static void spread_all(const struct spread *s, int threads, size_t under_way, double *const mesh[3])
{
	const struct pm_tile_pass *w = s->pass;
	const struct pm_current_fill fill = {s->c, s->nodes[0].shift, s->rests};
#pragma omp parallel num_threads(threads)
	for (size_t from = 0; from < w->jobs; from += under_way) {
		const size_t to = w->jobs - from < under_way ? w->jobs : from + under_way;
#pragma omp for schedule(dynamic, 1)
		for (size_t j = from; j < to; j++) {
			for (int c = 0; c < 3 && under_way == 1; c++) {
				unsigned char flip[3];
				const struct pm_tile_target t = pm_current_target(s->c, s->nodes, s->halves, c, flip);
				pm_tile_fetch_mesh(w, &w->job[j], &t, mesh[c]);
			}
			pm_current_fill(&fill, w, &w->job[j], s->blocks + (j - from) * 3 * PM_BLOCK_MOST,
				s->cells ? s->cells + omp_get_thread_num() : NULL);
		}
		for (size_t j = from; j < to; j++)
			for (int c = 0; c < 3; c++) {
				unsigned char flip[3];
				const struct pm_tile_target t = pm_current_target(s->c, s->nodes, s->halves, c, flip);
				pm_tile_add_block(w, &w->job[j], &t, omp_get_thread_num(), threads, s->blocks + ((j - from) * 3 + (size_t)c) * PM_BLOCK_MOST,
					mesh[c]);
			}
#pragma omp barrier
	}
}

struct pm_tile_particles pm_ways_particles(const struct pm_current *c, const struct pm_ways *ways, struct pm_ways_columns *columns)
{
	const int dim = c->grid.dim;
	for (int d = 0; d < dim; d++) {
		columns->at[d] = pm_column_doubles(ways->at[d]);
		columns->values[d] = pm_column_doubles(ways->way[d]);
	}
	columns->values[dim] = pm_column_doubles(ways->q);
	for (int d = dim; d < 3; d++)
		columns->values[1 + d] = pm_column_doubles(ways->along[d]);
	return (struct pm_tile_particles){.dim = dim, .nvalues = pm_current_values(dim), .n = ways->n, .x = columns->at, .values = columns->values};
}

/* The order of the particles, whose pass and blocks are then those of s. */
static int deposit_order(struct spread *s, struct pm_tile_order *order, size_t n, double *const mesh[3])
{
	struct pm_tile_pass pass = {.jobs = 0};
	const int threads = pm_tile_threads(n);
	size_t under_way = threads == 1 ? 1 : 8 * (size_t)threads;
	int status = pm_tile_pass_init(&pass, &s->c->grid, order, s->nodes);
	under_way = pass.jobs < under_way ? pass.jobs : under_way;
	s->pass = &pass;
	s->blocks = status ? NULL : pm_zalloc(under_way * 3 * PM_BLOCK_MOST + 1, sizeof *s->blocks);
	bool many = false; /* of a job: the sums are set to zero first */
	for (size_t j = 0; j < pass.jobs && !status; j++)
		many |= pass.job[j].to - pass.job[j].from >= pm_current_cells_least(s->c->kernel);
	status = status || !many ? status : pm_current_cells_new(&s->cells, threads, order->dim, s->c->kernel);
	if (!status && s->blocks && pass.jobs)
		spread_all(s, threads, under_way, mesh);
	status = status ? status : s->blocks ? 0 : -PM_DATA;
	pm_free(s->blocks);
	s->cells = pm_current_cells_free(s->cells);
	pm_tile_pass_free(&pass);
	return status;
}

const struct pm_tile_order *pm_current_order_left(const struct pm_current *c, size_t n, const struct pm_column x[3])
{
	const struct pm_transfer t = {.grid = c->grid, .kernel = c->kernel, .cut = true, .kept = c->kept}; /* cut: as for E and B */
	for (int d = 0; d < c->grid.dim; d++)
		if (c->grid.face[d][0] != PM_PERIODIC)
			return NULL;
	const struct pm_order_cache *left = pm_order_cache_find(&t, (const unsigned char[3]){0}, n, x);
	return left && pm_order_cache_stays(left) ? &left->order : NULL;
}

/* The order that was left, as one of ways. */
static int deposit_left(struct spread *s, const struct pm_tile_order *left, const struct pm_tile_particles *p, double *const mesh[3])
{
	struct pm_tile_order order = *left;
	order.ways = true, order.dt = p->dt, order.axes = s->nodes, order.nvalues = p->nvalues, order.stride = 2 * p->dim + p->nvalues;
	for (int d = 0; d < p->dim; d++)
		order.v[d] = p->v[d], order.columns |= !p->v[d].doubles;
	for (int k = 0; k < p->nvalues; k++)
		order.values[k] = p->values[k], order.columns |= p->values[k].floats != NULL;
	return deposit_order(s, &order, p->n, mesh);
}

/* Sorts, and deposits unless a particle is outside the box or `far` says that the stream is far from the order of tiles (NULL: it does not matter). */
static int deposit_particles(const struct pm_current *c, const struct pm_tile_particles *p, const bool *rests, double *const mesh[3], size_t *stray, bool *far)
{
	struct pm_axis nodes[3], halves[3];
	struct pm_tile_order order = {.n = 0};
	struct pm_strays strays = {.count = 0};
	struct spread s = {.c = c, .nodes = nodes, .halves = halves, .rests = rests};
	int status = pm_axes_path(nodes, halves, &c->grid, c->kernel->width);
	const struct pm_tile_order *left = p->v ? pm_current_order_left(c, p->n, p->x) : NULL;
	if (!status && left) {
		status = deposit_left(&s, left, p, mesh);
		pm_axes_free(nodes), pm_axes_free(halves);
		return status;
	}
	if (!status)
		status = pm_tile_order_init(&order, nodes, p, 2 * c->grid.dim + 1 + (3 - c->grid.dim), &strays);
	if (!status && strays.count) {
		*stray = strays.first;
		status = -PM_DATA;
	}
	if (far)
		*far = !status && !order.runs.run && pm_tile_order_spent(&order);
	if (!status && !(far && *far))
		status = deposit_order(&s, &order, p->n, mesh);
	pm_tile_order_free(&order);
	pm_axes_free(nodes);
	pm_axes_free(halves);
	return status;
}

static int deposit_ways(const struct pm_current *c, const struct pm_ways *ways, double *const mesh[3], size_t *stray)
{
	struct pm_ways_columns columns;
	const struct pm_tile_particles particles = pm_ways_particles(c, ways, &columns);
	return deposit_particles(c, &particles, NULL, mesh, stray, NULL);
}

/* Ways that are all straight pieces are found again where they are wanted, from particles that stay in the stream. */
static int deposit_straight(const struct pm_current *c, size_t n, const struct pm_column x[3], const struct pm_column v[3], const struct pm_column *q,
	double *const mesh[3], size_t *stray, bool *far)
{
	const int dim = c->grid.dim;
	struct pm_column values[4] = {*q};
	bool rests[3] = {false};
	for (int d = dim; d < 3; d++) {
		values[1 + d - dim] = v[d];
		rests[d] = !v[d].doubles && !v[d].floats && v[d].value == 0;
	}
	const struct pm_tile_particles particles = {.dim = dim, .nvalues = pm_current_values(dim) - dim, .n = n, .x = x, .values = values, .v = v, .dt = c->dt};
	return deposit_particles(c, &particles, rests, mesh, stray, far);
}

/* q v W at the middle of the way, folded. */
static int deposit_direct(const struct pm_current *c, size_t n, const double *const x[3], const double *const v[3], const double *q, double *const mesh[3])
{
	const int dim = c->grid.dim;
	struct pm_transfer t = {.grid = c->grid, .kernel = c->kernel, .components = 3, .planes = c->planes};
	struct pm_strays strays;
	double *memory = pm_alloc(n * 6 + 1, sizeof *memory), *middle[3], *current[3];
	if (pm_world_agree(memory ? 0 : pm_failed()))
		return pm_free(memory), -PM_DATA;
	for (int d = 0; d < 3; d++) {
		middle[d] = memory + n * (size_t)d;
		current[d] = memory + n * (size_t)(3 + d);
		t.staggered[d][d] = d < dim;
		t.flip[d][d] = 1;
		for (size_t p = 0; p < n; p++)
			current[d][p] = v[d] ? q[p] * v[d][p] : 0;
	}
	for (int d = 0; d < dim; d++) {
		const bool mirror[2] = {c->face[d][0] == PM_PREFLECT, c->face[d][1] == PM_PREFLECT};
		for (size_t p = 0; p < n; p++)
			middle[d][p] = x[d][p] + 0.5 * c->dt * (v[d] ? v[d][p] : 0);
		if (mirror[0] || mirror[1])
			pm_particle_faces_reflect(n, c->lo[d], c->hi[d], mirror, middle[d], 1, &current[d]);
	}
	int status = pm_spread(&t, n, (const double *const *)middle, (const double *const *)current, mesh, &strays);
	pm_free(memory);
	return status;
}

int pm_current_columns(const struct pm_current *c, size_t n, const struct pm_column x[3], const struct pm_column v[3], const struct pm_column *q,
	double *const j[3], size_t *stray, bool *far)
{
	*stray = n;
	*far = false;
	if (!n)
		return 0;
	*far = !c->few && (c->deposit == PM_DIRECT || !pm_ways_straight(c, n, x, v));
	return *far ? 0 : deposit_straight(c, n, x, v, q, j, stray, far);
}

int pm_current_add(const struct pm_current *c, size_t n, const double *const x[3], const double *const v[3], const double *q, double *const j[3],
	size_t *stray)
{
	struct pm_ways ways;
	const bool divided = c->planes && c->planes->divided;
	*stray = divided ? SIZE_MAX : n;
	if (!n && !divided)
		return 0;
	if (c->deposit == PM_DIRECT)
		return deposit_direct(c, n, x, v, q, j);
	bool far = divided;
	if (!far) {
		struct pm_column at[3], along[3], charge = pm_column_doubles(q);
		pm_columns_of(c->grid.dim, x, at), pm_columns_of(3, v, along);
		const int done = pm_current_columns(c, n, at, along, &charge, j, stray, &far);
		if (!far)
			return done;
	}
	int status = pm_ways_init(&ways, c, n, x, v, q);
	if (divided)
		status = pm_current_ranks(status, c, &ways, n, j, stray);
	else if (!status)
		status = deposit_ways(c, &ways, j, stray);
	pm_ways_free(&ways);
	return status;
}
