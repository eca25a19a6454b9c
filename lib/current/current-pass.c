/* The end of a step and the beginning of the next in one pass: for a few particles of a tile at a time E and B are gathered from the nodes that are in the
 * cache, the velocities are kicked by the half that closes the step and the half that opens the next one, and their currents are added to the sums of the
 * tile. The rates are never in memory. As in VPIC, Bowers et al. 2008, but for the words that stand beside each other in a sentence. Every way is one piece:
 * the box is periodic, and no particle passes a cell at the speed of light. Cost: positions, velocities and the order once.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <string.h>

#include "base/largest.h"
#include "law/law.h"
#include "stream/field-value.h"
#include "stream/later.h"
#include "current/current-parts.h"
#include "current/current-pass.h"
#include "transfer/gather-later.h"
#include "transfer/gather-staggered.h"

/* What makes velocities. */
struct maker {
	const struct pm_gather_left *left;
	const struct pm_later *later;
	struct pm_staggered_few *gather;
	double *v[3];
	int64_t (*most)[8]; /* [threads] of v, as pm_largest_few leaves it, in a line of the cache each */
};

static void make(void *data, const struct pm_tile_order *o, const struct pm_tile_job *j, size_t p, size_t m, double *const u[3],
	double *const way[3])
{
	const struct maker *k = data;
	enum { pack = PM_TILE_ORDER_PACK };
	double values[6 * pack], few[3][pack], room[3][pack], *v[3];
	const double *x[3], *all[6];
	const struct pm_tile_runs *runs = o->runs.run ? &o->runs : NULL;
	const bool together = !runs || pm_tile_runs_together(runs, p, m);
	const double factor = k->left->factor;
	const size_t at = runs ? pm_tile_runs_at(runs, p) : p;
	const int dim = o->dim;
	for (int d = 0; d < dim; d++)
		all[d] = o->x[d].doubles, x[d] = together ? all[d] + at : room[d];
	for (int c = 0; c < 3; c++)
		all[dim + c] = k->v[c], v[c] = together ? k->v[c] + at : few[c];
	if (runs)
		pm_tile_runs_fetch(runs, p + m, pack, dim + 3, all);
	if (!together) {
		double *to[6] = {NULL};
		for (int c = 0; c < dim + 3; c++)
			to[c] = c < dim ? room[c] : few[c - dim];
		pm_tile_runs_take(runs, p, m, dim + 3, all, to);
	}
	for (int d = 0; d < dim; d++)
		pm_axis_locate_many(&o->axes[d], m, x[d], u[d]);
	pm_staggered_few(k->gather, j, m, (const double *const *)u, values);
	for (int c = 0; c < 3 && factor != 1; c++) {
		double *restrict e = values + c * pack;
		for (size_t i = 0; i < m; i++)
			e[i] *= factor;
	}
	k->later->kicks->few(k->later, m, v, (const double *const[]){values, values + pack, values + 2 * pack},
		(const double *const[]){values + 3 * pack, values + 4 * pack, values + 5 * pack});
	int64_t *most = k->most[omp_get_thread_num()];
	for (int c = 0; c < 3; c++)
		pm_largest_few(m, v[c], most);
	for (int d = 0; d < dim; d++)
		pm_tile_ways(o->dt, o->axes[d].h, m, x[d], v[d], way[d]);
	if (!together)
		pm_tile_runs_put(runs, p, m, 3, (const double *const[]){few[0], few[1], few[2]}, k->v);
}

/* Does everything allow it? */
static bool can(const struct pm_current *c, const struct pm_frame *f, const struct pm_gather_left *l, const struct pm_field *x, const struct pm_field *q)
{
	const double light = pm_law_constant(f, "c", NAN);
	bool yes = l && c->deposit == PM_ESIRKEPOV && pm_value_is_one(q) && l->n == x->count;
	for (int d = 0; d < c->grid.dim && yes; d++)
		yes = c->grid.face[d][0] == PM_PERIODIC && c->face[d][0] == PM_PFOLD && c->face[d][1] == PM_PFOLD &&
			light * fabs(c->dt) < 0.999 * c->grid.h[d] && l->x[d].doubles == pm_column_of(x, d).doubles;
	return yes;
}

/* The order of the gather, where it is that of the current too, of one mesh with kernels of one width; found here where the particles were sorted since the
 * gather was left. NULL: it is not, or failure. */
static const struct pm_tile_order *order_of_both(const struct pm_current *c, const struct pm_gather_left *l, const struct pm_column x[3], int *status)
{
	struct pm_transfer t = l->t;
	t.kept = c->kept;
	*status = t.kernel->width == c->kernel->width ? pm_staggered_order(&t, l->n, x) : 0;
	return *status > 0 ? pm_current_order_left(c, l->n, x) : NULL;
}

static double speed_bound(const struct maker *k)
{
	int64_t most = 0;
	for (int t = 0; t < pm_threads(); t++)
		most = k->most[t][0] > most ? k->most[t][0] : most;
	return pm_of_bits(most);
}

int pm_current_pass(const struct pm_current_job *j, const struct pm_frame *f, const char *set, double *const mesh[3])
{
	struct pm_field *x = pm_frame_field(f, set, "x"), *v = pm_frame_field(f, set, "v"), *q = pm_frame_field(f, set, j->law->strength);
	struct pm_current c = j->current;
	struct pm_later *later = pm_field_later_alone(v);
	const struct pm_gather_left *l = later && later->kicks ? pm_gather_left_of(later->kicks->acc, later->kicks->bfield) : NULL;
	struct pm_column at[3] = {{.value = 0}}, along[3] = {{.value = 0}}, charge = pm_column_of(q, 0);
	size_t stray;
	bool far = false;
	c.kept = &x->note;
	for (int d = 0; d < f->dim; d++)
		at[d] = pm_column_of(x, d);
	int status = 0;
	const struct pm_tile_order *left = can(&c, f, l, x, q) ? order_of_both(&c, l, at, &status) : NULL;
	if (!left)
		return status < 0 ? status : 0;
	struct maker k = {.left = l, .most = pm_zalloc((size_t)pm_threads(), sizeof *k.most)};
	status = !k.most ? -PM_DATA : pm_staggered_few_new(&k.gather, &l->t, left, l->mesh, pm_tile_threads(x->count));
	struct pm_later *taken = status ? NULL : pm_field_later_take(v);
	k.later = taken;
	for (int d = 0; d < 3 && taken; d++) {
		k.v[d] = pm_out(v, d);
		along[d] = pm_column_doubles(k.v[d]);
	}
	c.few = &(struct pm_current_few){make, &k};
	status = taken ? pm_current_columns(&c, x->count, at, along, &charge, mesh, &stray, &far) : -PM_DATA;
	if (!status)
		v->within = speed_bound(&k);
	pm_later_free(taken);
	pm_staggered_few_free(k.gather), pm_free(k.most);
	return status ? status : 1;
}
