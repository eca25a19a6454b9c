/* Particles that stand on nodes of a mesh, inside its faces: density_i += strength_p / cell and out_p += factor_p value_i at the node i of particle p, since a
 * kernel that interpolates is 1 there and 0 at all other nodes. A node is where remesh puts it, lo + i h as rounded; the general loops find such a particle
 * some 1e-16 cells beside it. Ranks send particles to planes by these loops, on a mesh of unit cells, where that is exact: the same bytes.
 * Cost: two passes over the positions, one over the values. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "mesh/planes.h"
#include "stream/kept.h"
#include "transfer/on-nodes.h"
#include "transfer/tile-gradient.h"
#include "world/world.h"

enum { PIECE = 4096, FEW = 16, PART = PM_ON_NODES_FEW };

struct nodes {
	const struct pm_grid *g;
	size_t n;
	const double *x[3];
	size_t low[3], high[3]; /* the nodes on which particles may stand */
	double *at[3], *room;   /* [points] where the nodes of an axis are */
};

static bool interpolates(const struct pm_kernel *k)
{
	int ones = 0, zeros = 0;
	for (int i = 0; i < k->width; i++)
		ones += k->coefficients[i] == 1, zeros += k->coefficients[i] == 0;
	return !k->star && ones == 1 && zeros == k->width - 1;
}

/* The nodes of an axis whose particles are neither outside nor on a face. False: there are none. */
static bool range_of(const struct pm_transfer *t, int d, size_t *low, size_t *high)
{
	const enum pm_face *face = t->grid.face[d];
	const double n = (double)t->grid.cells[d], reach = 0.5 * t->kernel->width + t->rim;
	double from = 0, to = n - 1;
	if (face[0] != PM_PERIODIC) {
		from = face[0] == PM_WALL || face[0] == PM_NEUMANN ? 1 : floor(reach) + 1;
		to = face[1] == PM_WALL || face[1] == PM_NEUMANN ? n - 1 : ceil(n - reach) - 1;
	}
	*low = (size_t)from, *high = to < from ? 0 : (size_t)to;
	return to >= from && (face[0] == PM_PERIODIC || !t->cut);
}

static bool can(const struct pm_transfer *t, const struct pm_field *x, struct nodes *w)
{
	bool can = interpolates(t->kernel) && x->type == PM_F64 && !x->uniform;
	*w = (struct nodes){.g = &t->grid, .n = x->count};
	for (int d = 0; d < t->grid.dim && can; d++)
		can = range_of(t, d, &w->low[d], &w->high[d]);
	for (int c = 0; c < t->components && can; c++)
		for (int d = 0; d < t->grid.dim; d++)
			can = can && !t->staggered[c][d];
	return can;
}

static int begin(struct nodes *w, const struct pm_field *x)
{
	const struct pm_grid *g = w->g;
	w->room = pm_alloc(g->points[0] + g->points[1] + g->points[2], sizeof *w->room);
	if (!w->room)
		return -PM_DATA;
	for (int d = 0; d < 3; d++) {
		w->at[d] = d ? w->at[d - 1] + g->points[d - 1] : w->room;
		w->x[d] = d < g->dim ? pm_in(x, d) : NULL;
		for (size_t i = 0; i < g->points[d]; i++)
			w->at[d][i] = g->lo[d] + (double)i * g->h[d];
	}
	return 0;
}

/* The index along axis d of the node nearest to a place. */
static bool index_at(const struct pm_grid *g, int d, double x, size_t *i)
{
	const double u = (x - g->lo[d]) / g->h[d] + 0.5;
	if (!(u >= 0 && u < (double)g->points[d]))
		return false;
	*i = (size_t)u;
	return true;
}

/* The index along axis d of the only node that particle p may stand on; false: there is none. */
static bool index_of(const struct nodes *w, size_t p, int d, size_t *i)
{
	return index_at(w->g, d, w->x[d][p], i) && *i >= w->low[d] && *i <= w->high[d];
}

/* How many of n are equal to those of `at`, from the first on; or with one, to that. */
static size_t same_as(size_t n, const double *x, const double *at, bool one)
{
	size_t i = 0;
	for (int off = 0; i + FEW <= n; i += FEW) {
		for (int k = 0; k < FEW; k++)
			off |= x[i + (size_t)k] != at[one ? 0 : i + (size_t)k];
		if (off)
			break;
	}
	while (i < n && x[i] == at[one ? 0 : i])
		i++;
	return i;
}

/* How many particles from p on, at most those up to `end`, stand on nodes one after the other in a row, whose first is *node. 0: p stands on none. */
static size_t run_of(const struct nodes *w, size_t p, size_t end, size_t *node)
{
	const size_t *points = w->g->points;
	size_t i[3] = {0, 0, 0};
	for (int d = 0; d < w->g->dim; d++)
		if (!index_of(w, p, d, &i[d]))
			return 0;
	*node = (i[2] * points[1] + i[1]) * points[0] + i[0];
	size_t m = w->high[0] + 1 - i[0] < end - p ? w->high[0] + 1 - i[0] : end - p;
	m = same_as(m, w->x[0] + p, w->at[0] + i[0], false);
	for (int d = 1; d < w->g->dim; d++)
		m = same_as(m, w->x[d] + p, w->at[d] + i[d], true);
	return m;
}

typedef void do_run(const void *data, size_t node, size_t p, size_t m);

/* False: the particles from..to-1, or the one before, are not on nodes in the order of the mesh. To act it must be known that they are. */
static bool walk_piece(const struct nodes *w, size_t from, size_t to, do_run *act, const void *data)
{
	size_t last = 0, node, m;
	if (from && !act && !run_of(w, from - 1, from, &last))
		return false;
	for (size_t p = from; p < to; p += m, last = node + m - 1) {
		m = run_of(w, p, to, &node);
		if (!m || (p && !act && node <= last))
			return false;
		if (act)
			act(data, node, p, m);
	}
	return true;
}

/* As many particles as nodes: each stands on that of its number. */
static bool is_full(const struct nodes *w) { return w->n == pm_grid_size(w->g); }

static bool walk(const struct nodes *w, do_run *act, const void *data)
{
	int bad = 0;
	if (act && is_full(w)) {
#pragma omp parallel for schedule(static) if (w->n > 16384)
		for (size_t row = 0; row < w->n; row += w->g->points[0])
			act(data, row, row, w->g->points[0]);
		return true;
	}
#pragma omp parallel for schedule(static) reduction(| : bad) if (w->n > 16384)
	for (size_t from = 0; from < w->n; from += PIECE)
		bad = bad || !walk_piece(w, from, w->n - from < PIECE ? w->n : from + PIECE, act, data);
	return !bad;
}

/* The particles of every rank stand behind those of the ranks before. */
static int agree(int status, const struct nodes *w, bool *on)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank();
	int64_t *ends = pm_zalloc(1 + 2 * ranks, sizeof *ends), last = -1;
	size_t node;
	status = status ? status : ends ? 0 : pm_failed();
	if (!status) {
		ends[0] = !*on;
		if (*on && w->n && run_of(w, 0, 1, &node))
			ends[1 + me] = (int64_t)node;
		if (*on && w->n && run_of(w, w->n - 1, w->n, &node))
			ends[1 + ranks + me] = (int64_t)node + 1; /* 0: no particles */
	}
	status = pm_world_count(status, PM_SUM_OF, 1 + 2 * ranks, ends);
	*on = !status && !ends[0];
	for (size_t r = 0; r < ranks && *on; r++)
		if (ends[1 + ranks + r]) {
			*on = ends[1 + r] > last;
			last = ends[1 + ranks + r] - 1;
		}
	pm_free(ends);
	return status;
}

/* On which nodes they stand is kept with the positions. */
static const char name[] = "mesh of the nodes";

struct stand {
	struct pm_grid g;
	size_t low[3], high[3];
};

static bool is_kept(const struct nodes *w, const struct pm_field *x)
{
	const struct stand *kept = pm_kept(x, NULL, name);
	const struct pm_grid *g = w->g;
	bool same = kept;
	for (int d = 0; d < g->dim && same; d++)
		same = kept->g.points[d] == g->points[d] && kept->g.lo[d] == g->lo[d] && kept->g.h[d] == g->h[d] && kept->low[d] == w->low[d] &&
			kept->high[d] == w->high[d];
	return same;
}

static void keep(const struct nodes *w, const struct pm_field *x)
{
	struct stand *kept = pm_alloc(1, sizeof *kept);
	if (kept) {
		kept->g = *w->g;
		memcpy(kept->low, w->low, sizeof kept->low), memcpy(kept->high, w->high, sizeof kept->high);
	}
	if (!kept || !pm_keep(x, NULL, name, kept))
		pm_free(kept);
}

void pm_on_nodes_keep(const struct pm_grid *g, const struct pm_field *x)
{
	struct nodes w = {.g = g};
	bool found = true; /* not where the corner of the box is so far away that neighbours are rounded to one place */
	for (int d = 0; d < g->dim; d++) {
		w.high[d] = g->cells[d] - 1;
		for (size_t i = 0, at; i < g->cells[d]; i++)
			found = found && index_at(g, d, g->lo[d] + (double)i * g->h[d], &at) && at == i;
	}
	if (found)
		keep(&w, x);
}

int pm_on_nodes(const struct pm_transfer *t, const struct pm_field *x, bool *on)
{
	struct nodes w;
	*on = can(t, x, &w);
	if (!*on || is_kept(&w, x))
		return 0;
	int status = begin(&w, x);
	*on = !status && walk_piece(&w, 0, w.n < FEW ? w.n : FEW, NULL, NULL) && walk(&w, NULL, NULL);
	if (x->here)
		status = agree(status, &w, on);
	else
		*on = *on && w.n;
	if (*on)
		keep(&w, x);
	pm_free(w.room);
	return status;
}

/* With ranks: the same on a mesh of unit cells. */
struct unit {
	struct pm_transfer t;
	double *room;
	double *x[3], *values[PM_COMPONENTS];
};

static void keep_indices(const void *data, size_t node, size_t p, size_t m)
{
	const struct unit *u = data;
	const size_t *points = u->t.grid.points, i = node % points[0], at[] = {0, node / points[0] % points[1], node / points[0] / points[1]};
	for (int d = 0; d < u->t.grid.dim; d++)
		for (size_t k = 0; k < m; k++)
			u->x[d][p + k] = (double)(d ? at[d] : i + k);
}

static int begin_unit(struct unit *u, const struct pm_transfer *t, const struct nodes *w)
{
	*u = (struct unit){.t = *t, .room = pm_alloc(w->n * (size_t)(t->grid.dim + t->components) + 1, sizeof *u->room)};
	u->t.kept = NULL;
	for (int d = 0; d < t->grid.dim; d++) {
		u->t.grid.lo[d] = 0, u->t.grid.h[d] = 1;
		u->x[d] = u->room + (size_t)d * w->n;
	}
	for (int c = 0; c < t->components; c++)
		u->t.set[c] = true, u->values[c] = u->room + (size_t)(t->grid.dim + c) * w->n;
	if (!u->room)
		return -PM_DATA;
	walk(w, keep_indices, u);
	return 0;
}

static int spread_ranks(int status, const struct pm_transfer *t, const struct nodes *w, const struct pm_column strength[], double *const mesh[])
{
	const double scale = 1 / pm_grid_cell(&t->grid);
	struct pm_strays strays;
	struct unit u = {.room = NULL};
	status = pm_world_agree(status ? status : begin_unit(&u, t, w));
	for (int c = 0; c < t->components && !status; c++)
		for (size_t p = 0; p < w->n; p++)
			u.values[c][p] = pm_column_at(&strength[c], p) * scale;
	status = status ? status : pm_spread(&u.t, w->n, (const double *const *)u.x, (const double *const *)u.values, mesh, &strays);
	pm_free(u.room);
	return status;
}

struct spread {
	int components;
	bool replaces;
	double scale;
	const struct pm_column *strength;
	double *const *mesh;
};

static void spread_run(const void *data, size_t node, size_t p, size_t m)
{
	const struct spread *s = data;
	for (int c = 0; c < s->components; c++) {
		double *to = s->mesh[c] + node;
		const double *q = s->strength[c].doubles;
		if (q && s->replaces)
			for (size_t k = 0; k < m; k++)
				to[k] = 0 + q[p + k] * s->scale;
		else if (q)
			for (size_t k = 0; k < m; k++)
				to[k] += q[p + k] * s->scale;
		else
			for (size_t k = 0; k < m; k++)
				to[k] = (s->replaces ? 0 : to[k]) + pm_column_at(&s->strength[c], p + k) * s->scale;
	}
}

int pm_on_nodes_spread(const struct pm_transfer *t, const struct pm_field *x, const struct pm_column strength[], bool replaces, double *const mesh[])
{
	struct nodes w;
	int status = can(t, x, &w) ? begin(&w, x) : pm_fail(PM_DATA, "particles that are not on nodes");
	if (x->here)
		status = spread_ranks(status, t, &w, strength, mesh);
	else if (!status)
		walk(&w, spread_run, &(struct spread){t->components, replaces, 1 / pm_grid_cell(&t->grid), strength, mesh});
	pm_free(w.room);
	return status;
}

struct gather {
	const struct pm_transfer *t;
	const double *const *mesh; /* of ranks: what was gathered, by particles */
	const struct pm_column *factor;
	const struct pm_target *out;
	int *bad;
};

/* from: the values of the particles from p on. A negative zero becomes 0, as in a sum over nodes. */
static bool take(const struct gather *g, int c, const double *from, size_t p, size_t m)
{
	const struct pm_column *factor = &g->factor[c];
	double sum = 0;
	if (!g->out[c].doubles) {
		for (size_t k = 0; k < m; k++) {
			float *to = &g->out[c].floats[p + k];
			*to = (float)((g->t->set[c] ? 0 : (double)*to) + pm_column_at(factor, p + k) * (from[k] + 0.));
			sum += *to - *to;
		}
		return sum == 0;
	}
	double *to = g->out[c].doubles + p;
	if (g->t->set[c] && !factor->doubles && !factor->floats)
		for (size_t k = 0; k < m; k++)
			to[k] = factor->value * (from[k] + 0.);
	else
		for (size_t k = 0; k < m; k++)
			to[k] = (g->t->set[c] ? 0 : to[k]) + pm_column_at(factor, p + k) * (from[k] + 0.);
	return pm_finite_few(m, to);
}

/* m <= PART nodes of a row, of a gradient that is left to be made. */
static void make_row(const struct pm_transfer *t, size_t node, size_t m, double made[3][PART])
{
	const size_t *points = t->grid.points;
	pm_tile_gradient_row(t->gradient, (const size_t[]){node % points[0], node / points[0] % points[1], node / points[0] / points[1]}, m, made[0], PART);
}

static bool make_and_take(const struct gather *g, size_t node, size_t p, size_t m)
{
	double made[3][PART];
	bool finite = true;
	make_row(g->t, node, m, made);
	for (int c = 0; c < g->t->components; c++)
		finite &= take(g, c, made[c], p, m);
	return finite;
}

static void gather_run(const void *data, size_t node, size_t p, size_t m)
{
	const struct gather *g = data;
	bool finite = true;
	for (int c = 0; c < g->t->components && !g->t->gradient; c++)
		finite &= take(g, c, g->mesh[c] + node, p, m);
	for (size_t i = 0; i < m && g->t->gradient; i += PART)
		finite &= make_and_take(g, node + i, p + i, m - i < PART ? m - i : PART);
	if (!finite)
#pragma omp atomic write
		*g->bad = 1;
}

static int gather_ranks(int status, const struct nodes *w, const double *const mesh[], const struct gather *g)
{
	struct pm_strays strays;
	struct unit u = {.room = NULL};
	status = pm_world_agree(status ? status : begin_unit(&u, g->t, w));
	status = status ? status : pm_gather(&u.t, w->n, (const double *const *)u.x, mesh, NULL, u.values, &strays);
	for (int c = 0; c < g->t->components && !status; c++)
		*g->bad |= !take(g, c, u.values[c], 0, w->n);
	pm_free(u.room);
	return status;
}

int pm_on_nodes_gather(const struct pm_transfer *t, const struct pm_field *x, const double *const mesh[], const struct pm_column factor[],
	const struct pm_target out[], struct pm_strays *strays)
{
	struct nodes w;
	int bad = 0, status = can(t, x, &w) ? begin(&w, x) : pm_fail(PM_DATA, "particles that are not on nodes");
	const struct gather g = {t, mesh, factor, out, &bad};
	*strays = (struct pm_strays){.count = 0};
	if (x->here)
		status = gather_ranks(status, &w, mesh, &g);
	else if (!status)
		walk(&w, gather_run, &g);
	strays->finite = !bad;
	pm_free(w.room);
	return status;
}

struct pass {
	const struct pm_transfer *t;
	const double *const *mesh;
	double factor;
	pm_on_nodes_few *few;
	void *data;
};

static void pass_run(const void *data, size_t node, size_t p, size_t m)
{
	const struct pass *g = data;
	double made[3][PART], *const value[3] = {made[0], made[1], made[2]};
	for (size_t i = 0; i < m; i += PART) {
		const size_t many = m - i < PART ? m - i : PART;
		if (g->t->gradient)
			make_row(g->t, node + i, many, made);
		for (int c = 0; c < g->t->components; c++) {
			const double *from = g->t->gradient ? made[c] : g->mesh[c] + node + i;
			for (size_t k = 0; k < many; k++)
				made[c][k] = g->factor * (from[k] + 0.); /* as in take() */
		}
		g->few(g->data, p + i, many, value);
	}
}

int pm_on_nodes_pass(const struct pm_transfer *t, const struct pm_field *x, const double *const mesh[], double factor, pm_on_nodes_few *few, void *data)
{
	struct nodes w;
	int status = can(t, x, &w) ? begin(&w, x) : pm_fail(PM_DATA, "particles that are not on nodes");
	if (!status && !walk(&w, pass_run, &(struct pass){t, mesh, factor, few, data}))
		status = pm_fail(PM_DATA, "particles that are not on nodes");
	pm_free(w.room);
	return status;
}
