/* jump: Markov jump processes of particles, chance steps beside deterministic ones (lib/expression/jump-process.c).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "expression/jump-process.h"
#include "stage/strength-report.h"

struct config {
	const char *set;
	int64_t seed;
};

struct state {
	struct pm_jump_process process;
};

static int begin(struct pm_stage *s)
{
	int status = 0;
	for (int i = 0; i < s->nargs && !status; i++)
		status = pm_jump_check(s->args[i]);
	return status;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	return f->substep ? PM_PASS
		: pm_jump_declare(&((struct state *)s->state)->process, f, o->set, pm_given(s, "seed") ? (uint64_t)o->seed : f->seed, s->nargs, s->args);
}

static void strengths(const struct pm_jump_process *p, struct pm_strengths *sums)
{
	sums->n = 0;
	for (size_t k = 0; k < p->effects.n; k++)
		if (pm_is_strength(p->effects.job[k].field))
			pm_strengths_add(p->effects.job[k].field, sums);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_jump_process *p = &((struct state *)s->state)->process;
	struct pm_strengths before, after;
	uint64_t jumps;
	strengths(p, &before);
	const int status = pm_jump_step(p, f, &jumps);
	strengths(p, &after);
	pm_report_strengths(s, f, "given", &before, &after);
	pm_report_count(s, f, "jumps", jumps);
	return status;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return s && f; }

static void done(struct pm_stage *s) { pm_jump_free(&((struct state *)s->state)->process); }

static const struct pm_option options[] = {
	{.name = "seed", .kind = PM_INTEGER, .high = 9e15, PM_AT(seed), .text = "seed of the random numbers; by default the frame's"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "only this set; by default every set that has the states"},
	{0},
};
static const struct pm_example examples[] = {
	{"A + B -> 2 B in 1000 well-stirred volumes of 5 molecules each",
		"pinit lattice --dim 1 -n 1000 --dt 0.1 | scalc --role state 'a = 4' 'b = 1' | cycle -n 20 \"push drift | jump 'a*b/5: a = a-1; b = b+1'\" | "
		"scalc 'b2 = b^2' | sls --data"},
	{"bacteria that run and tumble: the velocity turns round at a rate of 1",
		"pinit uniform --dim 1 -n 1000 --dt 0.05 | scalc 'v = 1' | cycle -n 20 \"push drift | jump '1: v = -v'\" | sls --data"},
	{0},
};
const struct pm_tool tool_jump = {
	.name = "jump",
	.summary = "let the state of particles jump at given rates",
	.about = "Each argument is a channel, RATE: NAME = EXPRESSION; NAME = EXPRESSION, with expressions as in scalc. In a step of length dt a particle "
		"jumps by it with the probability 1 - exp(-RATE dt), and then takes the new values, all computed from the state before. Several channels "
		"compete, and a particle may jump several times in a step, by the rates of its new state: Gillespie's algorithm, particle by particle. "
		"Other words advance the state between the jumps (an error of first order in dt). Put it after the last push; inside a step the frame is "
		"passed on unchanged. The numbers depend on seed, set, channels, id (or index, where there is none) and step, not on order or threads. "
		"Reports the number of jumps. What was derived from the state is dropped. See docs/methods/jump.md.",
	.kind = PM_FILTER,
	.reads = "id and the fields in the expressions",
	.changes = "the fields they assign",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.arguments = "CHANNEL...",
	.arguments_text = "RATE: NAME = EXPRESSION; ...",
	.least = 1,
	.most = PM_JUMP_CHANNELS,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
	.free = done,
};
