/* field: a given rate of change, rate += expression (docs/methods/field.md; lib/expression/given-rates.c): an external field, a friction, a test equation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "expression/given-rates.h"
#include "stage/stage.h"

struct config {
	struct pm_given_rate_choice choice;
};

struct state {
	struct pm_expression_jobs jobs;
};

static int begin(struct pm_stage *s)
{
	int status = 0;
	for (int i = 0; i < s->nargs && !status; i++)
		status = pm_given_rate_check(s->args[i]);
	return status;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	struct pm_expression_jobs *jobs = &((struct state *)s->state)->jobs;
	int status = 0;
	jobs->n = 0;
	for (int i = 0; i < s->nargs && !status; i++)
		status = pm_given_rate_declare(jobs, &((const struct config *)s->config)->choice, f, s->args[i]);
	return status;
}

static int frame(struct pm_stage *s, struct pm_frame *f) { return pm_given_rates_add(&((struct state *)s->state)->jobs, f); }

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return s && f; }

static void done(struct pm_stage *s) { pm_expression_jobs_free(&((struct state *)s->state)->jobs); }

static const struct pm_option options[] = {
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(choice.set), .text = "only this set (default: every set that has the state)"},
	{.name = "term", .kind = PM_TEXT, .unit = "NAME", .fallback = "external", PM_AT(choice.term), .text = "the name of the term that is added"},
	{.name = "replace", .kind = PM_FLAG, PM_AT(choice.replace), .text = "replaces the rate instead of refusing to add the same term twice"},
	{0},
};

static const struct pm_example examples[] = {
	{"a cluster in the tide of a distant galaxy", "pinit plummer -n 100 | cycle -n 3 \"push kick/2 drift | pp | field 'acc = 0.02*x, -0.01*y, -0.01*z' | "
		"push kick/2\" | diag --columns time,energy_kinetic,speed_rms"},
	{"the test equation x' = i x, as two components, through a step of Runge-Kutta", "printf 'x y\\n1 0\\n' | stab - --law free --dt 0.1 | cycle -n 1 "
		"\"field 'vel = -y, x' | push rk4\" | stab --plain"},
	{"vortices that decay while they rotate", "pinit polygon -n 4 | cycle -n 5 \"pp | field 'dcirculation = -0.1*circulation' | push midpoint\" | diag "
		"--columns "
		"time,circulation"},
	{0}};

const struct pm_tool tool_field = {
	.name = "field",
	.summary = "add a given rate of change from an expression",
	.about = "acc (of v), vel (of x, for sets without v) or d and the name of any other state, dcirculation, plus the expression for every particle; "
		"commas make components: "
		 "'acc = -x, -y'. It is the term external, added to the terms of other words. Names and functions as in scalc: x y z, vx vy vz, "
		 "NAME, time, constants "
		 "of the frame. See docs/methods/field.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "the fields in the expressions",
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
	.divided = divided,
	.free = done,
};
