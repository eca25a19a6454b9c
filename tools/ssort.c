/* ssort: reorders the particles of a set in memory, by cell or by an expression, so that neighbours in space are neighbours in memory. Stable.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "expression/expression.h"
#include "cell/radix-sort.h"
#include "stage/stage.h"

struct config {
	const char *set, *mesh, *by;
	int64_t every;
	bool reverse;
};

static const struct pm_option options[] = {
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "sort this set only (every set without)"},
	{.name = "by", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(by), .text = "sort by this, ascending, instead of by cell: id, mass, 'hypot(x,y)'"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "sort by the cells of this mesh (the first without)"},
	{.name = "reverse", .kind = PM_FLAG, PM_AT(reverse), .text = "largest first"},
	{.name = "every", .kind = PM_INTEGER, .unit = "steps", .fallback = "1", .low = 1, .high = 1e15, PM_AT(every),
		.text = "sort only frames whose step is a multiple of this"},
	{0},
};

static bool chosen(const struct config *c, const struct pm_set *set) { return !c->set || !strcmp(c->set, set->name); }

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct pm_expression e;
	if (c->set && !pm_frame_set(f, c->set))
		return pm_fail(PM_DATA, "no set '%s' (sls lists what there is)", c->set);
	if (!c->by && !pm_frame_mesh(f, c->mesh))
		return pm_fail(PM_DATA, c->mesh ? "no mesh '%s' (sls lists what there is)" : "no mesh to sort by the cells of (use --by)", c->mesh);
	if (f->substep != 0 || f->step % c->every != 0)
		return PM_PASS;
	for (size_t i = 0; i < f->nsets; i++) {
		const char *on = f->sets[i]->name;
		if (!chosen(c, f->sets[i]))
			continue;
		int status = c->by ? pm_expression_compile(&e, f, on, c->by) : pm_reads(f, on, "x") ? 0 : -PM_DATA;
		if (status)
			return status;
		for (size_t k = 0, n = f->nfields; k < n;) { /* pm_changes moves a field to the end of the list */
			struct pm_field *p = f->fields[k];
			bool mine = !strcmp(p->on, on) && !p->uniform && !(p->use & PM_USE_CHANGE);
			if (mine)
				pm_changes(f, on, p->name), n--;
			else
				k++;
		}
	}
	return 0;
}

static int keys(const struct config *c, struct pm_frame *f, const char *on, size_t n, uint64_t *key, double *work)
{
	struct pm_expression e;
	if (!c->by) {
		struct pm_grid g = pm_grid_of(f, pm_frame_mesh(f, c->mesh));
		const struct pm_field *x = pm_frame_field(f, on, "x");
		const double *at[3] = {pm_in(x, 0), f->dim > 1 ? pm_in(x, 1) : NULL, f->dim > 2 ? pm_in(x, 2) : NULL};
		pm_keys_of_cells(&g, n, at, key);
		return 0;
	}
	const struct pm_field *p = pm_frame_field(f, on, c->by);
	if (p && p->type == PM_I64 && p->components == 1) { /* ids beyond 2^53 are told apart */
		pm_keys_of_integers(n, pm_in_i64(p, 0), key);
		return 0;
	}
	int status = pm_expression_compile(&e, f, on, c->by);
	if (status)
		return status;
	pm_expression_eval(&e, f, 0, n, work);
	if (!pm_finite(n, work))
		return pm_fail(PM_NUMERICS, "'%s' is not finite for every particle of '%s'", c->by, on);
	pm_keys_of_reals(n, work, key);
	return 0;
}

static int sort_set(const struct config *c, struct pm_frame *f, const struct pm_set *set)
{
	size_t n = set->n;
	uint64_t *key = pm_alloc(n ? 4 * n : 1, sizeof *key);
	size_t *order = (size_t *)(key + 2 * n);
	int status = key ? keys(c, f, set->name, n, key, (double *)(key + n)) : -PM_DATA;
	if (!status) {
		for (size_t i = 0; c->reverse && i < n; i++)
			key[i] = ~key[i];
		pm_keys_order(n, key, key + n, order, order + n);
	}
	for (size_t i = 0; i < f->nfields && !status; i++)
		if (!strcmp(f->fields[i]->on, set->name) && f->fields[i]->use & PM_USE_CHANGE)
			status = pm_field_permute(f->fields[i], order);
	pm_free(key);
	return status;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	int status = 0;
	for (size_t i = 0; i < f->nsets && !status; i++)
		if (chosen(s->config, f->sets[i]))
			status = sort_set(s->config, f, f->sets[i]);
	return status;
}

static const struct pm_example examples[] = {
	{"Particles by the cell of the mesh they are in.", "pinit plummer -n 2000 | ssort | sls"},
	{"Back in the order of their ids.", "pinit plummer -n 2000 > a; ssort < a | ssort --by id > b; scmp --by-index --set matter --tolerance 0 a b"},
	{"The ten innermost.", "pinit plummer -n 2000 | ssort --by 'x^2+y^2+z^2' | stab --plain | sed -n 1,11p"},
	{0}};

const struct pm_tool tool_ssort = {
	.name = "ssort",
	.summary = "reorders particles by cell or by an expression",
	.about = "Permutes every field of the set, so that particles that are near each other are so in memory and p2m, m2p and pair find them in the cache. "
		"By default by "
		 "the cells of the first mesh, in p2m's tiles of 32x16x8 (64x64, 4096) cells, x fastest; particles with equal keys keep their order. Only at "
		 "substep 0: other frames pass as they are. "
		 "No number changes; sums over particles may differ in the last digit, because they add in another order.",
	.kind = PM_FILTER,
	.reads = "x, or what --by names",
	.changes = "the order of all fields of the set",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.declare = declare,
	.frame = frame,
};
