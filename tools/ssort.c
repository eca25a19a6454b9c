/* ssort: reorders the particles of a set in memory, by cell or by an expression, so that neighbours in space are neighbours in memory. Stable.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "expression/particle-order.h"
#include "stage/stage.h"

struct config {
	struct pm_particle_order order;
	int64_t every;
};

struct state {
	bool whole, inside; /* frames have come that are whole steps, that are inside one */
};

static const struct pm_option options[] = {
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(order.set), .text = "sort only this set (default: every set)"},
	{.name = "by", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(order.by), .text = "sort by this expression, ascending, instead of by cell: id, mass, "
		"'hypot(x,y)'"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(order.mesh), .text = "sort by the cells of this mesh (default: the first)"},
	{.name = "reverse", .kind = PM_FLAG, PM_AT(order.reverse), .text = "largest first"},
	{.name = "every", .kind = PM_INTEGER, .unit = "steps", .fallback = "1", .low = 1, .high = 1e15, PM_AT(every),
		.text = "sort only frames whose step number is a multiple of this"},
	{0},
};

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct state *state = s->state;
	int status = pm_particle_order_check(&c->order, f);
	if (!s->trial)
		state->inside |= f->substep, state->whole |= !f->substep;
	return status ? status : f->substep || f->step % c->every ? PM_PASS : pm_particle_order_declare(&c->order, f);
}

static int frame(struct pm_stage *s, struct pm_frame *f) { return pm_particle_order_apply(&((const struct config *)s->config)->order, f); }

static int end(struct pm_stage *s)
{
	const struct state *state = s->state;
	if (state->inside && !state->whole)
		pm_note(s, "nothing is sorted: every frame lies inside a step (ssort behind the word that ends it)");
	return 0;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return s && f; }

static const struct pm_example examples[] = {
	{"Particles by the cell of the mesh they are in.", "pinit plummer -n 2000 | ssort | sls"},
	{"Back in the order of their ids.", "pinit plummer -n 2000 > a; ssort < a | ssort --by id > b; scmp --by-index --set matter --tolerance 0 a b"},
	{"The ten innermost.", "pinit plummer -n 2000 | ssort --by 'x^2+y^2+z^2' | stab --plain | sed -n 1,11p"},
	{0}};

const struct pm_tool tool_ssort = {
	.name = "ssort",
	.summary = "reorders particles by cell or by an expression",
	.about = "Permutes every field of the set, so that neighbours in space are neighbours in memory, and p2m, m2p and pse find them in the cache. "
		"By default by "
		 "the cells of the first mesh, in p2m's tiles of 32x16x8 (64x64, 4096) cells, x fastest; particles with equal keys keep their order. Acts "
		"only at "
		 "substep 0; other frames are passed on unchanged. No value changes, but sums over particles may differ in the last digit because of the "
		"other order.",
	.kind = PM_FILTER,
	.reads = "x, or the fields in --by",
	.changes = "the order of all fields of the set",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.declare = declare,
	.frame = frame,
	.divided = divided,
	.end = end,
};
