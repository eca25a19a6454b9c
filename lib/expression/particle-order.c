/* Keys of the particles, a stable radix sort of them, and the permutation of the fields. Cost N per set and pass of the sort.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "cell/radix-sort.h"
#include "cell/sort-ranks.h"
#include "expression/expression.h"
#include "expression/particle-order.h"
#include "stream/declare.h"
#include "stream/later.h"
#include "stream/reorder.h"

static bool chosen(const struct pm_particle_order *o, const struct pm_set *set) { return !o->set || !strcmp(o->set, set->name); }

int pm_particle_order_check(const struct pm_particle_order *o, const struct pm_frame *f)
{
	if (o->set && !pm_frame_set(f, o->set))
		return pm_fail(PM_DATA, "no set '%s' (sls lists what there is)", o->set);
	if (!o->by && !pm_frame_mesh(f, o->mesh))
		return pm_fail(PM_DATA, o->mesh ? "no mesh '%s' (sls lists what there is)" : "no mesh to sort by the cells of (use --by)", o->mesh);
	return 0;
}

static void change_all(struct pm_frame *f, const char *on)
{
	for (size_t k = 0, n = f->nfields; k < n;) { /* pm_changes moves a field to the end of the list */
		struct pm_field *p = f->fields[k];
		bool mine = !strcmp(p->on, on) && !p->uniform && !(p->use & PM_USE_CHANGE);
		if (mine) {
			struct pm_field *changed = pm_changes(f, on, p->name);
			if (changed)
				changed->use |= PM_USE_WAITS;
			n--;
		} else
			k++;
	}
}

int pm_particle_order_declare(const struct pm_particle_order *o, struct pm_frame *f)
{
	struct pm_expression e;
	int status = 0;
	for (size_t i = 0; i < f->nsets && !status; i++) {
		const char *on = f->sets[i]->name;
		if (!chosen(o, f->sets[i]))
			continue;
		status = o->by ? pm_expression_compile(&e, f, on, o->by) : pm_reads(f, on, "x") ? 0 : -PM_DATA;
		if (!status)
			change_all(f, on);
	}
	return status;
}

static int keys(const struct pm_particle_order *o, struct pm_frame *f, const char *on, size_t n, uint64_t *key, double *work)
{
	struct pm_expression e;
	if (!o->by) {
		struct pm_grid g = pm_grid_of(f, pm_frame_mesh(f, o->mesh));
		const struct pm_field *x = pm_frame_field(f, on, "x");
		const double *at[3] = {pm_in(x, 0), f->dim > 1 ? pm_in(x, 1) : NULL, f->dim > 2 ? pm_in(x, 2) : NULL};
		pm_keys_of_cells(&g, n, at, key);
		return 0;
	}
	const struct pm_field *p = pm_frame_field(f, on, o->by);
	if (p && p->type == PM_I64 && p->components == 1) { /* ids beyond 2^53 are distinguished */
		pm_keys_of_integers(n, pm_in_i64(p, 0), key);
		return 0;
	}
	int status = pm_expression_compile(&e, f, on, o->by);
	if (status)
		return status;
	pm_expression_eval(&e, f, 0, n, work);
	if (!pm_finite(n, work))
		return pm_fail(PM_NUMERICS, "'%s' is not finite for every particle of '%s'", o->by, on);
	pm_keys_of_reals(n, work, key);
	return 0;
}

/* A field of the set that the word uses: how many of its particles are here. NULL: none. */
static const struct pm_field *used_on(const struct pm_frame *f, const char *on)
{
	for (size_t i = 0; i < f->nfields; i++)
		if (!strcmp(f->fields[i]->on, on) && f->fields[i]->use)
			return f->fields[i];
	return NULL;
}

static bool permuted(const struct pm_field *p, const char *on) { return !strcmp(p->on, on) && p->use & PM_USE_CHANGE; }

static int sort_set(const struct pm_particle_order *o, struct pm_frame *f, const struct pm_set *set)
{
	const struct pm_field *used = used_on(f, set->name);
	const uint64_t *from = used ? used->from : NULL; /* the set is divided over the ranks */
	size_t n = used ? used->count : (size_t)set->n;
	uint64_t *key = pm_alloc(n ? 4 * n : 1, sizeof *key);
	size_t *order = (size_t *)(key + 2 * n);
	struct pm_sort_ranks ranks;
	struct pm_reorder r = {.order = order};
	int status = key ? 0 : -PM_DATA;
	for (size_t i = 0; i < f->nfields && (from || !n) && !status; i++)
		if (permuted(f->fields[i], set->name))
			status = pm_field_now(f->fields[i]);
	status = status ? status : keys(o, f, set->name, n, key, (double *)(key + n));
	for (size_t i = 0; o->reverse && !status && i < n; i++)
		key[i] = ~key[i];
	if (!n && !from)
		return pm_free(key), status;
	if (from)
		status = pm_sort_ranks_init(status, from, n, key, &ranks);
	else if (!status)
		pm_keys_order(n, key, key + n, order, order + n);
	for (size_t i = 0; i < f->nfields; i++)
		if (permuted(f->fields[i], set->name) && (from || !status))
			status = from ? pm_sort_ranks_permute(status, &ranks, f->fields[i]) : pm_field_reorder(f->fields[i], &r);
	if (from)
		pm_sort_ranks_free(&ranks);
	pm_reorder_free(&r);
	pm_free(key);
	return status;
}

int pm_particle_order_apply(const struct pm_particle_order *o, struct pm_frame *f)
{
	int status = 0;
	for (size_t i = 0; i < f->nsets && !status; i++)
		if (chosen(o, f->sets[i]))
			status = sort_set(o, f, f->sets[i]);
	return status;
}
