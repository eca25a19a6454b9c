/* field: a given rate of change, rate += expression (docs/methods/field.md): an external field, a friction, a test equation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "expression/expression.h"
#include "stage/stage.h"

struct config {
	const char *set, *term;
	bool replace;
};

struct job { /* one rate of one set */
	struct pm_field *rate;
	struct pm_expression e;
};

struct state {
	struct job *job; /* of the frame under way */
	size_t njobs, room;
};

/* The state whose rate of change `name` is; NULL: none. */
static const char *state_of(const char *name) { return !strcmp(name, "acc") ? "v" : !strcmp(name, "vel") ? "x" : name[0] == 'd' && name[1] ? name + 1 : NULL; }

static int begin(struct pm_stage *s)
{
	char name[PM_NAME];
	const char *expression;
	for (int i = 0; i < s->nargs; i++) {
		if (pm_expression_named(s->args[i], name, &expression))
			return -PM_USAGE;
		if (!state_of(name) || !strcmp(name, "dx") || !strcmp(name, "dv"))
			return pm_fail(PM_USAGE, "'%s' is no rate of change (acc of v, vel of x, or d before any other state: dcirculation)", name);
	}
	return 0;
}

static bool is_state(const struct pm_field *p) { return p && p->role == PM_STATE; }

/* Does the rate move the set? x has one only where there is no v. */
static bool moves(const struct pm_frame *f, const char *set, const char *of)
{
	return is_state(pm_frame_field(f, set, of)) && (strcmp(of, "x") || !is_state(pm_frame_field(f, set, "v")));
}

/* As many parts as the state has components; a velocity may have more than there are axes. */
static int fits(const struct pm_frame *f, const struct pm_field *state, const char *name, const struct pm_expression *e)
{
	if (state->type == PM_I64 || state->type == PM_U8)
		return pm_fail(PM_DATA, "'%s' on '%s' holds whole numbers, which have no rate of change", state->name, state->on);
	if (e->nparts != state->components && (strcmp(name, "acc") || e->nparts != f->dim))
		return pm_fail(PM_DATA, "'%s' on '%s' has %d components, and '%s' here %d (one expression each, commas between)", state->name, state->on,
			state->components, name, e->nparts);
	for (int i = 0; i < e->nvalues; i++)
		if (!strcmp(e->value[i].field, name))
			return pm_fail(PM_DATA, "'%s' is what is added to, and cannot be read (write it in terms of the state)", name);
	return 0;
}

static int plan_rate(struct pm_stage *s, struct pm_frame *f, const char *set, const char *name, const char *expression)
{
	const struct config *c = s->config;
	struct state *st = s->state;
	const struct pm_field *state = pm_frame_field(f, set, state_of(name));
	if (st->njobs == st->room) {
		struct job *more = realloc(st->job, (2 * st->room + 4) * sizeof *more);
		if (!more)
			return pm_fail(PM_DATA, "out of memory");
		st->job = more;
		st->room = 2 * st->room + 4;
	}
	struct job *job = st->job + st->njobs;
	int status = pm_expression_compile(&job->e, f, set, expression);
	if (!status)
		status = fits(f, state, name, &job->e);
	if (status)
		return status;
	job->rate = pm_contributes(f, set, name, state->name, job->e.nparts, c->term, c->replace);
	if (!job->rate)
		return -PM_DATA;
	job->rate->extensive = state->extensive;
	if (job->rate->use & PM_USE_NEW)
		job->rate->use |= PM_USE_FILL;
	st->njobs++;
	return 0;
}

static int plan_one(struct pm_stage *s, struct pm_frame *f, const char *argument)
{
	const struct config *c = s->config;
	struct state *st = s->state;
	char name[PM_NAME];
	const char *expression = NULL;
	size_t before = st->njobs;
	int status = pm_expression_named(argument, name, &expression);
	if (!status && c->set && !pm_frame_set(f, c->set))
		return pm_fail(PM_DATA, "no set '%s' (sls lists the sets)", c->set);
	const char *of = state_of(name);
	for (size_t i = 0; i < f->nsets && !status; i++)
		if ((!c->set || !strcmp(c->set, f->sets[i]->name)) && moves(f, f->sets[i]->name, of))
			status = plan_rate(s, f, f->sets[i]->name, name, expression);
	if (!status && st->njobs == before)
		return pm_fail(PM_DATA, "'%s' moves nothing: no %sset has the state '%s'%s", name, c->set ? "such " : "", of,
			strcmp(of, "x") ? "" : " without a velocity v (acc is the rate of change of v)");
	return status;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	int status = 0;
	((struct state *)s->state)->njobs = 0;
	for (int i = 0; i < s->nargs && !status; i++)
		status = plan_one(s, f, s->args[i]);
	return status;
}

static int add(const struct pm_frame *f, const struct job *job)
{
	size_t n = job->rate->count;
	double *more = pm_alloc(n ? n : 1, sizeof *more);
	for (int c = 0; c < job->e.nparts && more; c++) {
		double *rate = pm_out(job->rate, c);
		pm_expression_eval(&job->e, f, c, n, more);
#pragma omp parallel for schedule(static) if (n > 16384)
		for (size_t i = 0; i < n; i++)
			rate[i] += more[i];
	}
	pm_free(more);
	return more ? 0 : -PM_DATA;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct state *st = s->state;
	int status = 0;
	for (size_t k = 0; k < st->njobs && !status; k++) {
		const struct job *job = st->job + k;
		if (job->rate->use & PM_USE_FILL)
			pm_expression_assign(&job->e, f, job->rate);
		else
			status = add(f, job);
	}
	return status;
}

static void done(struct pm_stage *s) { free(((struct state *)s->state)->job); }

static const struct pm_option options[] = {
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "this set only (default: every set with the state whose rate is given)"},
	{.name = "term", .kind = PM_TEXT, .unit = "NAME", .fallback = "external", PM_AT(term), .text = "the name under which it is added"},
	{.name = "replace", .kind = PM_FLAG, PM_AT(replace), .text = "computes the rate anew instead of refusing to add the same term twice"},
	{0},
};

static const struct pm_example examples[] = {
	{"a cluster in the tide of a distant galaxy", "pinit plummer -n 100 | cycle -n 3 \"push kick/2 drift | pp | field 'acc = 0.02*x, -0.01*y, -0.01*z' | push kick/2\" | diag"},
	{"the test equation x' = i x, as two components, through a step of Runge-Kutta", "printf 'x y\\n1 0\\n' | stab - --law free --dt 0.1 | cycle -n 1 \"field 'vel = -y, x' | push rk4\" | stab --plain"},
	{"vortices that fade while they turn", "pinit polygon -n 4 | cycle -n 5 \"pp | field 'dcirculation = -0.1*circulation' | push rk2\" | diag --columns time,circulation"},
	{0}};

const struct pm_tool tool_field = {
	.name = "field",
	.summary = "add a given rate of change from an expression",
	.about = "acc (of v), vel (of x, for sets without v) or d and the name of any other state, dcirculation, plus the expression for every particle; commas make components: "
		 "'acc = -x, -y'. It counts as the term external and stands beside what other words add. Names and functions as in scalc: x y z, vx vy vz, NAME, time, constants "
		 "of the frame. See docs/methods/field.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "what the expressions name",
	.adds = "acc, vel or d<state> (term external)",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.arguments = "RATE=EXPRESSION...",
	.arguments_text = "Rates of change to add.",
	.least = 1,
	.most = 16,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.free = done,
};
