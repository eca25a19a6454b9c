/* field: a given rate of change, rate += expression (docs/methods/field.md; lib/expression/given-rates.c): an external field, a friction, a test equation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "expression/given-rates.h"
#include "stage/h5-pipe.h"
#include "stage/stage.h"
#include "transfer/field-of-file.h"

struct config {
	struct pm_given_rate_choice choice;
	const char *file, *kernel;
};

struct state {
	struct pm_expression_jobs jobs;
	struct pm_frame *from; /* of --file */
};

static struct pm_file_field given_by_file(const struct pm_stage *s)
{
	const struct config *c = s->config;
	return (struct pm_file_field){.from = ((const struct state *)s->state)->from, .path = c->file, .kernel = c->kernel, .set = c->choice.set,
		.term = c->choice.term, .replace = c->choice.replace};
}

static int begin(struct pm_stage *s)
{
	const struct config *c = s->config;
	int status = 0;
	if (!c->file == !s->nargs)
		return pm_fail(PM_USAGE, "field needs rates of change, or --file; of both a word each (field --term NAME)");
	if (c->kernel && !c->file)
		return pm_fail(PM_USAGE, "--kernel belongs to --file");
	if (c->file && !strcmp(c->file, "-"))
		return pm_fail(PM_USAGE, "--file reads a file of its own, and standard input is the stream");
	for (int i = 0; i < s->nargs && !status; i++)
		status = pm_given_rate_check(s->args[i]);
	return c->file ? pm_h5_pipe_first(c->file, &((struct state *)s->state)->from) : status;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	struct pm_expression_jobs *jobs = &((struct state *)s->state)->jobs;
	int status = 0;
	if (((const struct config *)s->config)->file) {
		const struct pm_file_field c = given_by_file(s);
		return pm_file_field_declare(&c, f);
	}
	jobs->n = 0;
	for (int i = 0; i < s->nargs && !status; i++)
		status = pm_given_rate_declare(jobs, &((const struct config *)s->config)->choice, f, s->args[i]);
	return status;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_file_field c = given_by_file(s);
	return c.path ? pm_file_field_add(&c, f) : pm_given_rates_add(&((struct state *)s->state)->jobs, f);
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return s && f; }

static void done(struct pm_stage *s)
{
	struct state *state = s->state;
	pm_expression_jobs_free(&state->jobs);
	state->from = pm_frame_free(state->from);
}

static const struct pm_option options[] = {
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(choice.set), .text = "only this set (default: every set that has the state)"},
	{.name = "term", .kind = PM_TEXT, .unit = "NAME", .fallback = "external", PM_AT(choice.term), .text = "the name of the term that is added"},
	{.name = "file", .kind = PM_TEXT, .unit = "FILE", PM_AT(file), .text = "instead of rates: the law's field and the magnetic field (E, g, u; B) on the "
		"meshes of the first frame of this stream, at the particles"},
	{.name = "kernel", .letter = 'k', .kind = PM_WORD, .choices = pm_kernel_names, PM_AT(kernel), .text = "with --file: the interpolation kernel (default: "
		"cic)"},
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
	{"a magnetic field from a file", "pinit exb --cells 32 | scalc --mesh mesh 'B = 0, 0, 1 + 0.01*x' 'E = 0, 0.1' > given.pm; pinit exb | "
		"sel --drop E,B | cycle -n 3 'push boris/2 drift | field --file given.pm | push boris/2' | diag --columns time,momentum_x"},
	{0}};

const struct pm_tool tool_field = {
	.name = "field",
	.summary = "add a given rate of change from an expression, or a field from a file",
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
	.most = 16,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
	.free = done,
};
