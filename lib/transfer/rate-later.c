/* The force, or flow, of a mesh left to be made: the field and the positions are held as they are. A push that kicks and moves has it gathered for a few
 * particles at a time, whose positions and velocities it changes at once, so that the rates are never in memory, and so does a scheme that moves by a flow;
 * where somebody asks for them they are gathered as a whole.
 * The limit of orbits (rates.h), which only the rates tell, is found then; until then it is known not to be above that of the largest field on the mesh.
 * Cost: a pass over the field, for its largest value, where that is not known well enough. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "limit/rates.h"
#include "mesh/gradient-later.h"
#include "transfer/on-nodes.h"
#include "transfer/rate-later.h"
#include "transfer/transfer-pass.h"
#include "world/world.h"

struct pm_rate_left {
	struct pm_later later; /* first member; from: the positions */
	struct pm_transfer t;
	struct pm_field *mesh;            /* the field, as it is */
	struct pm_order_cache *order;     /* of the positions */
	struct pm_field *charge, *mass;   /* whose quotient the field is times, particle by particle; NULL: `factor` for all */
	double factor, pull;
	double most, times;               /* of |rate|; of the particles' |factor| */
	int dim;
	bool on_nodes;                    /* and there is no order */
};

static void let_go(struct pm_later *later)
{
	struct pm_rate_left *l = (struct pm_rate_left *)later;
	pm_order_cache_free(l->order);
	pm_held_free(l->mesh), pm_held_free(l->charge), pm_held_free(l->mass);
}

/* The field as it is now: somebody may have had it made. */
static void look_at_mesh(const struct pm_rate_left *l, struct pm_transfer *t, const double *mesh[PM_COMPONENTS])
{
	*t = l->t;
	t->gradient = pm_gradient_later_of(l->mesh);
	for (int c = 0; c < t->components; c++)
		mesh[c] = t->gradient ? NULL : pm_in(l->mesh, c);
}

static void quotients(struct pm_column q, struct pm_column m, size_t n, double *to)
{
	for (size_t i = 0; i < n; i++)
		to[i] = pm_column_at(&q, i) / pm_column_at(&m, i);
}

static int make(const struct pm_later *later, double *to)
{
	const struct pm_rate_left *l = (const struct pm_rate_left *)later;
	struct pm_transfer t;
	struct pm_column x[3], times[PM_COMPONENTS];
	struct pm_target out[PM_COMPONENTS];
	const double *mesh[PM_COMPONENTS];
	struct pm_strays strays;
	struct pm_note *kept = l->order ? &l->order->note : NULL;
	double *ratio = l->charge ? pm_alloc(later->from->count, sizeof *ratio) : NULL;
	if (l->charge && !ratio)
		return -PM_DATA;
	if (ratio)
		quotients(pm_column_of(l->charge, 0), pm_column_of(l->mass, 0), later->from->count, ratio);
	look_at_mesh(l, &t, mesh);
	t.kept = &kept;
	for (int d = 0; d < l->dim; d++)
		x[d] = pm_column_of(later->from, d);
	for (int c = 0; c < t.components; c++) {
		times[c] = (struct pm_column){.doubles = ratio, .value = l->factor};
		out[c] = (struct pm_target){.doubles = to + (size_t)c * later->from->count};
	}
	const int status = l->on_nodes ? pm_on_nodes_gather(&t, later->from, mesh, times, out, &strays)
				       : pm_gather_columns(&t, later->from->count, x, mesh, times, out, &strays);
	pm_free(ratio);
	return status;
}

static double oscillation(const struct pm_later *later, const double *rate)
{
	const struct pm_rate_left *l = (const struct pm_rate_left *)later;
	const size_t n = later->from->count;
	double most = 0;
#pragma omp parallel for schedule(static) reduction(max : most) if (n > pm_many_turns())
	for (size_t i = 0; i < n; i++) {
		double square = 0;
		for (int c = 0; c < l->t.components; c++)
			square += rate[(size_t)c * n + i] * rate[(size_t)c * n + i];
		most = fmax(most, square);
	}
	return sqrt(pm_orbit_rate(l->dim, sqrt(most), l->pull));
}

const struct pm_rate_left *pm_rate_left_of(const struct pm_field *rate)
{
	const struct pm_later *later = pm_field_later_of(rate);
	return later && later->make == make ? (const struct pm_rate_left *)later : NULL;
}

double pm_rate_left_most(const struct pm_rate_left *l) { return l->most; }

/* The largest |field| of the nodes, and no less than that of a kernel's sums. near: by a pass where it need not be one. */
static double largest(const struct pm_rate_left *l, bool near)
{
	const size_t points = pm_grid_size(&l->t.grid);
	struct pm_transfer t;
	const double *mesh[PM_COMPONENTS];
	double most = 0;
	const double sums = l->t.kernel->positive ? 1 + 1e-9 : 8; /* the sizes of weights whose sum is 1 add up to 1.6 at most on an axis */
	look_at_mesh(l, &t, mesh);
	if (t.gradient)
		return sums * (near ? pm_gradient_later_most(t.gradient) : t.gradient->within);
#pragma omp parallel for schedule(static) reduction(max : most) if (points > pm_many_turns())
	for (size_t i = 0; i < points; i++) {
		double square = 0;
		for (int c = 0; c < t.components; c++)
			square += mesh[c][i] * mesh[c][i];
		most = square > most ? square : most;
	}
	return sums * sqrt(most);
}

static double most(const struct pm_later *later, double enough)
{
	const struct pm_rate_left *l = (const struct pm_rate_left *)later;
	const double far = sqrt(pm_orbit_rate(l->dim, l->most, l->pull));
	return far > enough ? sqrt(pm_orbit_rate(l->dim, l->times * largest(l, true), l->pull)) : far;
}

static struct pm_order_cache *order_of(const struct pm_transfer *t, struct pm_note **kept, const struct pm_field *x)
{
	struct pm_transfer here = *t;
	struct pm_column at[3];
	here.kept = kept;
	for (int d = 0; d < t->grid.dim; d++)
		at[d] = pm_column_of(x, d);
	struct pm_order_cache *o = pm_order_cache_find(&here, t->staggered[0], x->count, at);
	return o && !o->strays.count && !o->order.floats ? o : NULL;
}

static bool can(const struct pm_gather_job *j, struct pm_frame *f, const char *set, const struct pm_gather_arrays *a)
{
	const struct pm_field *rate = pm_frame_field(f, set, j->law->change), *of = pm_frame_field(f, set, j->law->of), *x = pm_frame_field(f, set, "x");
	const struct pm_transfer *t = &a->t;
	bool yes = pm_world_alone() && a->columns && !j->changes.n && !j->interlaced && !t->kernel->star && a->n && of && (of == x || !strcmp(of->name, "v")) &&
		rate->type == PM_F64 && rate->use & PM_USE_NEW && rate->use & PM_USE_FILL && x->type == PM_F64 && j->field->type == PM_F64;
	for (int d = 0; d < t->grid.dim && yes; d++)
		yes = t->grid.face[d][0] == PM_PERIODIC && a->at[d].doubles;
	for (int c = 0; c < t->components && yes; c++)
		yes = t->set[c] && a->times[c].doubles == a->times[0].doubles && !a->times[c].floats &&
			!memcmp(t->staggered[c], t->staggered[0], sizeof t->staggered[c]);
	return yes && (a->on_nodes || order_of(t, t->kept, x));
}

int pm_rate_leave(const struct pm_gather_job *j, struct pm_frame *f, const char *set, const struct pm_gather_arrays *a, bool *left)
{
	*left = false;
	if (!can(j, f, set, a))
		return 0;
	struct pm_rate_left *l = calloc(1, sizeof *l);
	if (!l)
		return pm_no_memory();
	*l = (struct pm_rate_left){.later = {.make = make, .free = let_go}, .t = a->t, .factor = a->times[0].value, .pull = j->pull, .dim = f->dim,
		.on_nodes = a->on_nodes};
	l->t.kept = NULL, l->t.planes = NULL, l->t.gradient = NULL;
	const char *const q = j->law->strength, *const m = j->law->per;
	const double *ratio = a->times[0].doubles;
	if (!l->on_nodes)
		l->order = pm_order_cache_hold(order_of(&a->t, a->t.kept, pm_frame_field(f, set, "x")));
	l->mesh = pm_field_held(j->field);
	l->charge = ratio ? pm_field_held(pm_frame_field(f, set, q)) : NULL, l->mass = ratio ? pm_field_held(pm_frame_field(f, set, m)) : NULL;
	if (!l->mesh || (ratio && (!l->charge || !l->mass)))
		return pm_later_free(&l->later), -PM_DATA;
	double range[2] = {l->factor, l->factor};
	if (ratio)
		pm_ratio_range(f, set, q, m, ratio, range);
	l->times = fmax(fabs(range[0]), fabs(range[1])), l->most = l->times * largest(l, false);
	if (pm_orbit_rate(l->dim, l->most, l->pull) > 0) /* on a line none */
		l->later.most = most, l->later.oscillation = oscillation;
	if (!(l->most < 1e100)) { /* not: the squares may have been infinite */
		pm_later_free(&l->later);
		return 0;
	}
	*left = true;
	return pm_field_later(pm_frame_field(f, set, j->law->change), &l->later, pm_frame_field(f, set, "x"));
}

/* ---- the pass ---- */

struct passing {
	int dim, rates;
	double *x[3];
	struct pm_rate_beside beside;
	struct pm_column factor;
	pm_rate_few *few;
	void *data;
};

static void take(void *data, const struct pm_tile_order *o, size_t p, size_t m, double *const places[], double *const rate[])
{
	enum { pack = PM_TILE_ORDER_PACK, line = 8 };
	_Static_assert((int)pack <= (int)PM_RATE_FEW && (int)PM_ON_NODES_FEW <= (int)PM_RATE_FEW, "room of those who take them");
	const struct passing *k = data;
	const struct pm_tile_runs *runs = o->runs.run ? &o->runs : NULL;
	const bool together = !runs || pm_tile_runs_together(runs, p, m), known = places && !together;
	const size_t at = runs ? pm_tile_runs_at(runs, p) : p;
	const int dim = k->dim, all = dim + k->beside.n;
	double few[PM_TILE_RUNS_MOST][pack], ratio[pack], *y[PM_TILE_RUNS_MOST] = {NULL}, *from[PM_TILE_RUNS_MOST];
	const double *read[PM_TILE_RUNS_MOST];
	for (int c = 0; c < all; c++) {
		read[c] = from[c] = c < dim ? k->x[c] : k->beside.of[c - dim];
		y[c] = together ? from[c] + at : c < dim && known ? places[c] : few[c];
	}
	const int first = known ? dim : 0; /* positions were taken, and the next ones fetched, before the gather */
	if (runs && first < all)
		pm_tile_runs_fetch(runs, p + m, pack, all - first, read + first);
	if (!together && first < all)
		pm_tile_runs_take(runs, p, m, all - first, read + first, y + first);
	const double *factor = k->factor.doubles ? pm_tile_order_take(o, p, m, &k->factor, ratio) : NULL;
	for (size_t i = 0; i < m && factor && together; i += line)
		__builtin_prefetch(factor + PM_TILE_AHEAD + i);
	for (int c = 0; c < k->rates && factor; c++)
		for (size_t i = 0; i < m; i++)
			rate[c][i] *= factor[i];
	k->few(k->data, m, y, y + dim, (const double *const *)rate);
	if (!together)
		pm_tile_runs_put(runs, p, m, dim + k->beside.back, (const double *const *)y, from);
}

/* m particles of the stream from p on, on nodes. */
static void take_here(void *data, size_t p, size_t m, double *const rate[])
{
	const struct passing *k = data;
	double *x[3] = {NULL}, *beside[PM_TILE_RUNS_MOST];
	for (int d = 0; d < k->dim; d++)
		x[d] = k->x[d] + p;
	for (int c = 0; c < k->beside.n; c++)
		beside[c] = k->beside.of[c] + p;
	for (int c = 0; c < k->rates && k->factor.doubles; c++)
		for (size_t i = 0; i < m; i++)
			rate[c][i] *= k->factor.doubles[p + i];
	k->few(k->data, m, x, beside, (const double *const *)rate);
}

static bool is_held(const struct pm_frame *f, const char *set, const struct pm_field *held)
{
	const struct pm_field *now = held ? pm_frame_field(f, set, held->name) : NULL;
	return !held || (now && now->buffer == held->buffer && now->value[0] == held->value[0]);
}

bool pm_rate_can_pass(const struct pm_rate_left *l, const struct pm_frame *f, struct pm_field *x)
{
	return pm_field_in_place(x, 1) && pm_column_of(l->later.from, 0).doubles == pm_column_of(x, 0).doubles && is_held(f, x->on, l->charge) &&
		is_held(f, x->on, l->mass) && (l->on_nodes || order_of(&l->t, &x->note, x));
}

int pm_rate_pass(const struct pm_rate_left *l, const struct pm_frame *f, struct pm_field *x, const struct pm_rate_beside *beside, pm_rate_few *few, void *data)
{
	struct passing k = {.dim = l->dim, .rates = l->t.components, .beside = *beside, .few = few, .data = data};
	struct pm_transfer t;
	struct pm_column at[3];
	const double *mesh[PM_COMPONENTS];
	double *made = NULL;
	int status = l->charge ? pm_ratio(f, x->on, l->charge->name, l->mass->name, &k.factor.doubles, &made) : 0;
	look_at_mesh(l, &t, mesh);
	t.kept = &x->note;
	for (int d = 0; d < l->dim; d++)
		k.x[d] = pm_out(x, d), at[d] = pm_column_doubles(k.x[d]);
	const double factor = l->charge ? 1 : l->factor;
	if (!status)
		status = l->on_nodes ? pm_on_nodes_pass(&t, x, mesh, factor, take_here, &k)
				     : pm_gather_taken(&t, x->count, at, mesh, factor, &(struct pm_tile_taker){take, &k});
	pm_free(made);
	pm_field_changed(x);
	return status;
}
