/* scalc: new fields from expressions (docs/methods/expressions.md; lib/expression/computed-fields.c).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "expression/computed-fields.h"
#include "stage/strength-report.h"

static const char *const roles[] = {"auto", "state", "derived", NULL}, *const types[] = {"f64", "f32", "i64", NULL};

struct config {
	struct pm_list sets, meshes;
	const char *role, *unit, *type, *per;
	bool strength, total;
};

struct state {
	struct pm_expression_jobs jobs;
};

static const struct pm_option options[] = {
	{.name = "set", .kind = PM_LIST, .unit = "NAME", PM_AT(sets), .text = "sets to compute on (default: every set, unless --mesh is given)"},
	{.name = "mesh", .kind = PM_LIST, .unit = "NAME", PM_AT(meshes), .text = "meshes to compute on"},
	{.name = "role", .kind = PM_WORD, .fallback = "auto", .choices = roles, PM_AT(role),
		.text = "role of a new field: state survives when particles move, derived does not; auto: state with --extensive, else derived"},
	{.name = "extensive", .kind = PM_FLAG, PM_AT(strength), .text = "new fields are strengths (extensive)"},
	{.name = "unit", .kind = PM_TEXT, .unit = "UNIT", PM_AT(unit), .text = "unit of the fields"},
	{.name = "type", .kind = PM_WORD, .fallback = "f64", .choices = types, PM_AT(type), .text = "how new fields are stored; i64 takes the floor"},
	{.name = "total", .kind = PM_FLAG, PM_AT(total), .text = "each field is the sum of its expression over all particles of the set"},
	{.name = "per", .kind = PM_TEXT, .unit = "NAME", PM_AT(per), .text = "with --total: over the particles with the same value of this field"},
	{0},
};

static int begin(struct pm_stage *s)
{
	const struct config *c = s->config;
	char name[PM_NAME];
	const char *expression;
	if (c->per && !c->total)
		return pm_fail(PM_USAGE, "--per %s says of which particles --total is the sum (add --total)", c->per);
	for (int i = 0; i < s->nargs; i++)
		if (pm_expression_named(s->args[i], name, &expression))
			return -PM_USAGE;
	return 0;
}

static struct pm_computed_choice choice(const struct config *c)
{
	const bool state = !strcmp(c->role, "state") || (!strcmp(c->role, "auto") && c->strength);
	return (struct pm_computed_choice){.role = state ? PM_STATE : PM_DERIVED, .extensive = c->strength, .unit = c->unit, .total = c->total, .per = c->per,
		.type = !strcmp(c->type, "f32") ? PM_F32 : !strcmp(c->type, "i64") ? PM_I64 : PM_F64};
}

static int declare_on(struct pm_stage *s, struct pm_frame *f, const char *on, bool *changed)
{
	const struct pm_computed_choice how = choice(s->config);
	int status = 0;
	for (int i = 0; i < s->nargs && !status; i++)
		status = pm_computed_declare(&((struct state *)s->state)->jobs, &how, f, on, s->args[i], changed);
	return status;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct state *st = s->state;
	bool changed = false;
	int status = 0;
	st->jobs.n = 0;
	for (int i = 0; i < c->sets.n && !status; i++)
		status = pm_frame_set(f, c->sets.item[i]) ? declare_on(s, f, c->sets.item[i], &changed)
			: pm_fail(PM_DATA, "no set '%s' (sls lists what there is)", c->sets.item[i]);
	for (int i = 0; i < c->meshes.n && !status; i++)
		status = pm_frame_mesh(f, c->meshes.item[i]) ? declare_on(s, f, c->meshes.item[i], &changed)
			: pm_fail(PM_DATA, "no mesh '%s' (sls lists what there is)", c->meshes.item[i]);
	for (size_t i = 0; !c->sets.n && !c->meshes.n && i < f->nsets && !status; i++)
		status = declare_on(s, f, f->sets[i]->name, &changed);
	if (!status && !st->jobs.n)
		return pm_fail(PM_DATA, "no set to compute on (species, stab and pinit make one; a mesh is named with --mesh)");
	return !status && changed ? pm_computed_outdate(&st->jobs, f) : status;
}

static void strengths(const struct pm_expression_jobs *jobs, struct pm_strengths *sums)
{
	sums->n = 0;
	for (size_t k = 0; k < jobs->n; k++)
		if (jobs->job[k].field->use & PM_USE_CHANGE && pm_is_strength(jobs->job[k].field))
			pm_strengths_add(jobs->job[k].field, sums);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_expression_jobs *jobs = &((struct state *)s->state)->jobs;
	const struct pm_computed_choice how = choice(s->config);
	struct pm_strengths before, after;
	strengths(jobs, &before);
	int status = pm_computed_apply(jobs, &how, f);
	strengths(jobs, &after);
	pm_report_strengths(s, f, "given", &before, &after);
	return status;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return s && f; }

static void done(struct pm_stage *s) { pm_expression_jobs_free(&((struct state *)s->state)->jobs); }

static const struct pm_example examples[] = {
	{"The speed of every particle.", "pinit plummer -n 100 | scalc 'speed = sqrt(vx^2 + vy^2 + vz^2)' | sls --data"},
	{"Two groups by position, and a charge for each.", "pinit plummer -n 100 | scalc --role state --type i64 'side = x > 0' | scalc --extensive 'charge "
		"= side ? 1 : -1' | sls"},
	{"The particles on the right, counted: the same number on each.", "pinit uniform -n 100 | scalc --total 'right = x > 0.5' | sls --data"},
	{"A mesh field from another.", "pinit plummer -n 1000 | p2m | scalc --mesh mesh 'logrho = log10(rho + 1e-6)' | sls --data"},
	{0}};

const struct pm_tool tool_scalc = {
	.name = "scalc",
	.summary = "new fields from expressions",
	.about = "Computes NAME = EXPRESSION for every particle of a set or point of a mesh, in the order given; commas make the components of a vector: 'w "
		"= -y, x'. An existing field is overwritten; if it is state, everything derived from the state is dropped. Names: x y z, vx vy vz, NAME, "
		"NAME_0, "
		 "NAME.x; "
		 "on a mesh x y z are the coordinates of the point; time dt step n dim pi Lx Ly Lz and the constants of the law (G, softening). Operators ^ "
		 "* / + - < <= > >= == != && || ! ?:. "
		 "Functions: sqrt cbrt exp log log10 sin cos tan asin acos atan atan2 sinh cosh tanh abs sign floor ceil round mod min max hypot pow erf "
		 "erfc gamma. "
		 "A result that is not finite is exit 3.",
	.kind = PM_FILTER,
	.reads = "the fields in the expressions",
	.adds = "the fields they define",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.arguments = "NAME=EXPRESSION...",
	.arguments_text = "Fields to compute.",
	.least = 1,
	.most = 32,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
	.free = done,
};
