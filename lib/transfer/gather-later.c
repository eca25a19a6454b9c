/* acc and bfield left to be made: the fields and the positions are held as they are, and what a pass does not make a few at a time is gathered when it is
 * asked for. The rate of gyration, which only the values at the particles tell, is found then. Cost: a pass over the mesh, for its largest values.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "stream/field-value.h"
#include "stream/later.h"
#include "stream/reorder.h"
#include "transfer/gather-later.h"
#include "transfer/gather-staggered.h"
#include "transfer/transfer-pass.h"
#include "world/world.h"

struct gather_later {
	struct pm_later later; /* first member */
	struct pm_gather_left *left;
	int first; /* component */
};

static void let_go(struct pm_gather_left *l)
{
	if (--l->users)
		return;
	for (int i = 0; i < 3; i++)
		pm_held_free(l->held[i]);
	pm_free(l->waits);
	free(l);
}

static void later_free(struct pm_later *later) { let_go(((struct gather_later *)later)->left); }

/* Who asks for one as a rule asks for the other: both are gathered at once, and the other one waits. */
static int make(const struct pm_later *later, double *to)
{
	const struct gather_later *g = (const struct gather_later *)later;
	struct pm_gather_left *l = g->left;
	const size_t bytes = 3 * l->n * sizeof *to;
	struct pm_column times[6];
	struct pm_target out[6];
	struct pm_strays strays = {.count = 0};
	if (l->waits) {
		memcpy(to, l->waits, bytes);
		l->waits = pm_free(l->waits);
		return 0;
	}
	if (!(l->waits = pm_alloc(3 * l->n, sizeof *l->waits)))
		return -PM_DATA;
	for (int c = 0; c < 6; c++) {
		times[c] = (struct pm_column){.value = c < 3 ? l->factor : 1};
		out[c] = (struct pm_target){.doubles = ((c < 3) == (g->first == 0) ? to : l->waits) + (size_t)(c % 3) * l->n};
	}
	return pm_gather_columns(&l->t, l->n, l->x, l->mesh, times, out, &strays);
}

/* Of B: the largest |q B/m|. */
static double gyration(const struct pm_later *later, const double *b)
{
	const struct pm_gather_left *l = ((const struct gather_later *)later)->left;
	const double *y = b + l->n, *z = y + l->n;
	double most = 0;
#pragma omp parallel for schedule(static) reduction(max : most) if (l->n > 16384)
	for (size_t i = 0; i < l->n; i++)
		most = fmax(most, b[i] * b[i] + y[i] * y[i] + z[i] * z[i]);
	return l->rate * sqrt(most);
}

/* In an order in which they are no longer near each other the gather costs more, and the pass is not made; nothing else is lost. */
static struct pm_gather_left *left_reorder(const struct pm_gather_left *was, struct pm_reorder *r)
{
	struct pm_gather_left *l = calloc(1, sizeof *l);
	if (!l)
		return pm_no_memory(), NULL;
	*l = *was;
	l->users = 1, l->waits = NULL;
	l->held[0] = pm_held_reorder(was->held[0], r), l->held[1] = pm_field_held(was->held[1]), l->held[2] = pm_field_held(was->held[2]);
	if (!l->held[0] || !l->held[1] || !l->held[2] || pm_reorder_add(r, was, l))
		return let_go(l), NULL;
	for (int d = 0; d < l->t.grid.dim; d++)
		l->x[d] = pm_column_of(l->held[0], d);
	return l;
}

static struct pm_later *reorder(const struct pm_later *later, struct pm_reorder *r)
{
	struct gather_later *g = malloc(sizeof *g);
	if (!g)
		return pm_no_memory(), NULL;
	*g = *(const struct gather_later *)later;
	struct pm_gather_left *known = pm_reorder_find(r, g->left);
	g->later.from = NULL;
	if (known)
		known->users++;
	g->left = known ? known : left_reorder(g->left, r);
	return g->left ? &g->later : (free(g), NULL);
}

static const struct gather_later *later_of(const struct pm_field *field)
{
	const struct pm_later *later = pm_field_later_of(field);
	return later && later->make == make ? (const struct gather_later *)later : NULL;
}

const struct pm_gather_left *pm_gather_left_of(const struct pm_field *acc, const struct pm_field *bfield)
{
	const struct gather_later *a = later_of(acc), *b = later_of(bfield);
	return a && b && a->left == b->left && a->first == 0 && b->first == 3 ? a->left : NULL;
}

static bool fresh(const struct pm_field *field)
{
	return field->type == PM_F64 && field->components == 3 && field->use & PM_USE_NEW && field->use & PM_USE_FILL;
}

static bool can(const struct pm_gather_job *j, const struct pm_frame *f, const char *set, const struct pm_gather_arrays *a)
{
	const struct pm_field *acc = pm_frame_field(f, set, j->law->change), *b = pm_frame_field(f, set, "bfield");
	const struct pm_grid *g = &a->t.grid;
	bool yes = pm_world_alone() && a->columns && a->magnetic && a->t.components == 6 && j->law->per && fresh(acc) && fresh(b) && a->n && !a->t.kernel->star;
	/* Doubles beside floats are gone when the word ends. */
	yes = yes && j->field->type == PM_F64 && pm_frame_field(f, j->mesh->name, j->law->magnetic)->type == PM_F64;
	for (int d = 0; d < g->dim && yes; d++)
		yes = g->face[d][0] == PM_PERIODIC && a->at[d].doubles;
	/* one charge and one mass, not their quotient alone */
	yes = yes && pm_value_is_one(pm_frame_field(f, set, j->law->strength)) && pm_value_is_one(pm_frame_field(f, set, j->law->per));
	for (int c = 0; c < 6 && yes; c++)
		yes = a->t.set[c] && !a->times[c].doubles && !a->times[c].floats;
	return yes;
}

/* The largest values of the mesh; can no sum of them overflow? */
static bool moderate(struct pm_gather_left *l)
{
	const size_t points = pm_grid_size(&l->t.grid);
	for (int k = 0; k < 2; k++) {
		double most = 0;
#pragma omp parallel for schedule(static) reduction(max : most) if (points > 65536)
		for (size_t i = 0; i < points; i++) {
			const double x = l->mesh[3 * k][i], y = l->mesh[3 * k + 1][i], z = l->mesh[3 * k + 2][i], square = x * x + y * y + z * z;
			most = square > most ? square : most;
		}
		l->most[k] = 4 * sqrt(most); /* of kernels that are no splines the sizes of weights have a sum above 1 */
	}
	return fmax(l->most[0], l->most[1]) * fmax(1, fabs(l->factor)) < 1e100; /* not: the squares may have been infinite */
}

static int leave(struct pm_field *field, struct pm_gather_left *l, int first)
{
	struct gather_later *g = calloc(1, sizeof *g);
	if (!g)
		return pm_no_memory();
	*g = (struct gather_later){.left = l, .first = first,
		.later = {.make = make, .free = later_free, .oscillation = first ? gyration : NULL, .reorder = reorder}};
	l->users++;
	return pm_field_later(field, &g->later, l->held[0]);
}

int pm_gather_leave(const struct pm_gather_job *j, struct pm_frame *f, const char *set, const struct pm_gather_arrays *a, bool *left)
{
	*left = false;
	int status = can(j, f, set, a) ? pm_staggered_order(&a->t, a->n, a->at) : 0;
	if (status <= 0)
		return status;
	struct pm_gather_left *l = calloc(1, sizeof *l);
	if (!l)
		return pm_no_memory();
	const struct pm_field *held[3] = {pm_frame_field(f, set, "x"), j->field, pm_frame_field(f, j->mesh->name, j->law->magnetic)};
	const struct pm_field *q = pm_frame_field(f, set, j->law->strength), *m = pm_frame_field(f, set, j->law->per);
	*l = (struct pm_gather_left){.users = 1, .t = a->t, .n = a->n, .factor = a->times[0].value, .rate = fabs(q->value[0] / m->value[0])};
	l->t.kept = NULL, l->t.planes = NULL;
	memcpy(l->x, a->at, sizeof l->x), memcpy(l->mesh, a->mesh, sizeof l->mesh);
	status = 0;
	for (int i = 0; i < 3 && !status; i++)
		status = (l->held[i] = pm_field_held(held[i])) ? 0 : -PM_DATA;
	if (!status && moderate(l)) {
		status = leave(pm_frame_field(f, set, j->law->change), l, 0);
		status = status ? status : leave(pm_frame_field(f, set, "bfield"), l, 3);
		*left = !status;
	}
	let_go(l);
	return status;
}
