/* perturb: every number of the state moved at random by its last bit (lib/push/state-perturb.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include "push/state-perturb.h"
#include "stage/stage.h"

struct config {
	struct pm_list on, fields;
	int64_t seed;
	double relative;
};

static struct pm_perturb asked(const struct config *c)
{
	return (struct pm_perturb){.on = c->on.item, .fields = c->fields.item, .seed = (uint64_t)c->seed, .relative = c->relative};
}

static int begin(struct pm_stage *s)
{
	const struct config *c = s->config;
	if (c->on.n == PM_LIST_MOST || c->fields.n == PM_LIST_MOST) /* the lists end in NULL */
		return pm_fail(PM_USAGE, "--field and --set allow at most %d names", PM_LIST_MOST - 1);
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_perturb p = asked(s->config);
	const int n = pm_perturb_declare(&p, f);
	if (n == 0)
		return pm_fail(PM_DATA, "no field of role state with real numbers to move%s (sls lists the fields)",
			p.on[0] || p.fields[0] ? " of these names" : "");
	return n < 0 ? n : 0;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_perturb p = asked(s->config);
	pm_perturb_apply(&p, f);
	return 0;
}

static const struct pm_option options[] = {
	{.name = "seed", .kind = PM_INTEGER, .fallback = "1", .high = 9e15, PM_AT(seed), .text = "seed of the random numbers"},
	{.name = "relative", .kind = PM_REAL, .fallback = "0", .high = 1, PM_AT(relative),
		.text = "move each number by this fraction of itself; by default by one unit in the last place"},
	{.name = "set", .kind = PM_LIST, .unit = "NAME", PM_AT(on), .text = "only these sets and meshes"},
	{.name = "field", .letter = 'f', .kind = PM_LIST, .unit = "NAME", PM_AT(fields), .text = "only these fields"},
	{0},
};

static const struct pm_example examples[] = {
	{"a cluster as it is, and one that differs in the last bit of each number: how far apart are they after 5 times?",
		"pinit plummer -n 50 > a; perturb < a > b; for i in a b; do cycle -n 100 'push kick/2 drift | pp | push kick/2' < $i > $i.end; "
		"done; scmp --field x a.end b.end"},
	{0},
};

const struct pm_tool tool_perturb = {
	.name = "perturb",
	.summary = "move every number of the state by its last bit, at random",
	.about = "Each number of a state field goes up or down by one unit in the last place of its type (f64, f32), or by --relative. 0, what all particles "
		"share (a uniform mass), integers and sets that do not move stay as they are. The choice depends on seed, set, field, id and component "
		"alone. Derived and change fields are dropped. The word digits runs a sentence on several such inputs.",
	.kind = PM_FILTER,
	.reads = "id",
	.changes = "state fields",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
