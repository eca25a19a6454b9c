/* scalc: new fields from expressions (docs/methods/expressions.md). SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "expression/expression.h"
#include "stage/stage.h"

static const char *const roles[] = {"auto", "state", "derived", NULL}, *const types[] = {"f64", "f32", "i64", NULL};

struct config {
	struct pm_list sets, meshes;
	const char *role, *unit, *type;
	bool strength;
};

struct job {
	struct pm_field *field;
	struct pm_expression e;
};

struct state {
	struct job *job; /* of the frame under way */
	size_t njobs, room;
};

static const struct pm_option options[] = {
	{.name = "set", .kind = PM_LIST, .unit = "NAME", PM_AT(sets), .text = "sets to compute on (every set without, unless --mesh is given)"},
	{.name = "mesh", .kind = PM_LIST, .unit = "NAME", PM_AT(meshes), .text = "meshes to compute on"},
	{.name = "role", .kind = PM_WORD, .fallback = "auto", .choices = roles, PM_AT(role),
		.text = "role of a new field: state survives when particles move, derived does not; auto: state with --extensive, else derived"},
	{.name = "extensive", .kind = PM_FLAG, PM_AT(strength), .text = "new fields are strengths (extensive)"},
	{.name = "unit", .kind = PM_TEXT, .unit = "UNIT", PM_AT(unit), .text = "unit to write beside the fields"},
	{.name = "type", .kind = PM_WORD, .fallback = "f64", .choices = types, PM_AT(type), .text = "how new fields are stored; i64 takes the floor"},
	{0},
};

static int begin(struct pm_stage *s)
{
	char name[PM_NAME];
	const char *expression;
	for (int i = 0; i < s->nargs; i++)
		if (pm_expression_named(s->args[i], name, &expression))
			return -PM_USAGE;
	return 0;
}

/* What was computed from state that has changed is worth nothing. */
static int stale(struct pm_frame *f, const struct state *st)
{
	for (size_t i = f->nfields; i-- > 0;) {
		struct pm_field *p = f->fields[i];
		bool ours = false;
		for (size_t k = 0; k < st->njobs; k++)
			ours |= st->job[k].field == p;
		if (ours || (p->role != PM_DERIVED && p->role != PM_CHANGE))
			continue;
		if (p->use & PM_USE_READ)
			return pm_fail(PM_DATA, "'%s' was computed from state that is changed here (one scalc to read it, then another to change the state)", p->name);
		pm_drops(f, p);
	}
	return 0;
}

/* The field to compute: an old one is rewritten, a new one made. */
static struct pm_field *target(const struct config *c, struct pm_frame *f, const char *on, const char *name, const struct pm_expression *e)
{
	struct pm_field *p = pm_frame_field(f, on, name);
	if (p && (p->components != e->nparts || p->role == PM_CHANGE || p->role == PM_REGISTER)) {
		if (p->components != e->nparts)
			pm_fail(PM_DATA, "'%s' on '%s' has %d components, here are %d (one expression each, commas between)", name, on, p->components, e->nparts);
		else
			pm_fail(PM_DATA, "'%s' on '%s' is a %s field, which only the stages that add to it may change", name, on, pm_role_names[p->role]);
		return NULL;
	}
	if (p)
		return pm_changes(f, on, name);
	enum pm_role role = !strcmp(c->role, "state") || (!strcmp(c->role, "auto") && c->strength) ? PM_STATE : PM_DERIVED;
	if (!(p = pm_makes(f, on, name, e->nparts, role)))
		return NULL;
	p->extensive = c->strength;
	p->type = !strcmp(c->type, "f32") ? PM_F32 : !strcmp(c->type, "i64") ? PM_I64 : PM_F64;
	return p;
}

static int plan_on(struct pm_stage *s, struct pm_frame *f, const char *on, bool *changed)
{
	const struct config *c = s->config;
	struct state *st = s->state;
	for (int i = 0; i < s->nargs; i++) {
		char name[PM_NAME];
		const char *expression;
		if (st->njobs == st->room) {
			struct job *more = realloc(st->job, (st->room = 2 * st->room + 8) * sizeof *more);
			if (!more)
				return pm_fail(PM_DATA, "out of memory");
			st->job = more;
		}
		struct job *job = st->job + st->njobs;
		pm_expression_named(s->args[i], name, &expression);
		int status = pm_expression_compile(&job->e, f, on, expression);
		if (status)
			return status;
		*changed |= pm_frame_field(f, on, name) && pm_frame_field(f, on, name)->role == PM_STATE;
		if (!(job->field = target(c, f, on, name, &job->e)))
			return -PM_DATA;
		if (c->unit)
			snprintf(job->field->unit, PM_NAME, "%.63s", c->unit);
		st->njobs++;
	}
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct state *st = s->state;
	bool changed = false;
	int status = 0;
	st->njobs = 0;
	for (int i = 0; i < c->sets.n && !status; i++)
		status = pm_frame_set(f, c->sets.item[i]) ? plan_on(s, f, c->sets.item[i], &changed) : pm_fail(PM_DATA, "no set '%s' (sls lists what there is)", c->sets.item[i]);
	for (int i = 0; i < c->meshes.n && !status; i++)
		status = pm_frame_mesh(f, c->meshes.item[i]) ? plan_on(s, f, c->meshes.item[i], &changed) : pm_fail(PM_DATA, "no mesh '%s' (sls lists what there is)", c->meshes.item[i]);
	for (size_t i = 0; !c->sets.n && !c->meshes.n && i < f->nsets && !status; i++)
		status = plan_on(s, f, f->sets[i]->name, &changed);
	if (!status && !st->njobs)
		return pm_fail(PM_DATA, "no set to compute on (name a mesh with --mesh)");
	return !status && changed ? stale(f, st) : status;
}

static int integers(struct pm_frame *f, const struct job *job)
{
	size_t n = job->field->count;
	double *y = pm_alloc(n ? n : 1, sizeof *y);
	int status = y ? 0 : -PM_DATA;
	for (int c = 0; c < job->e.nparts && !status; c++) {
		pm_expression_eval(&job->e, f, c, n, y);
		for (size_t i = 0; i < n && !status; i++) {
			double v = floor(y[i]);
			if (!(v >= -0x1p63 && v < 0x1p63))
				status = pm_fail(PM_NUMERICS, "'%s' is no whole number that fits at index %zu", job->field->name, i);
			else
				pm_out_i64(job->field, c)[i] = (int64_t)v;
		}
	}
	pm_free(y);
	return status;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct state *st = s->state;
	int status = 0;
	for (size_t k = 0; k < st->njobs && !status; k++) {
		const struct job *job = st->job + k;
		if (job->field->type == PM_U8)
			status = pm_fail(PM_DATA, "'%s' holds bytes, which scalc does not compute", job->field->name);
		else if (job->field->type == PM_I64)
			status = integers(f, job);
		else
			pm_expression_assign(&job->e, f, job->field);
	}
	return status;
}

static void done(struct pm_stage *s) { free(((struct state *)s->state)->job); }

static const struct pm_example examples[] = {
	{"The speed of every particle.", "pinit plummer -n 100 | scalc 'speed = sqrt(vx^2 + vy^2 + vz^2)' | sls --data"},
	{"Two groups by position, and a charge for each.", "pinit plummer -n 100 | scalc --role state --type i64 'side = x > 0' | scalc --extensive 'charge = side ? 1 : -1' | sls"},
	{"A mesh field from another.", "pinit plummer -n 1000 | p2m | scalc --mesh mesh 'logrho = log10(rho + 1e-6)' | sls --data"},
	{0}};

const struct pm_tool tool_scalc = {
	.name = "scalc",
	.summary = "new fields from expressions",
	.about = "Computes NAME = EXPRESSION for every particle of a set or point of a mesh, in the order given; commas make the components of a vector: 'w = -y, x'. A field that is "
		 "there already is rewritten; if it is state, everything that was derived from the state is dropped. Names: x y z, vx vy vz, NAME, NAME_0, NAME.x; "
		 "on a mesh x y z are the coordinates of the point; time dt step n dim pi Lx Ly Lz and the constants of the law (G, softening). Operators ^ * / + - < <= > >= == != && || ! ?:. "
		 "Functions: sqrt cbrt exp log log10 sin cos tan asin acos atan atan2 sinh cosh tanh abs sign floor ceil round mod min max hypot pow erf erfc gamma. "
		 "A result that is not finite is exit 3.",
	.kind = PM_FILTER,
	.reads = "what the expressions name",
	.adds = "what they define",
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
	.free = done,
};
