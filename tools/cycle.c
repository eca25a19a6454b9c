/* cycle: runs a sentence again and again on a frame, one step after the other (lib/cycle/loop.c).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cycle/loop.h"

static int begin(struct pm_stage *s)
{
	const struct pm_loop *c = s->config;
	if (c->steps == INT64_MIN && isnan(c->time) && !c->until)
		return pm_fail(PM_USAGE, "how long? (-n STEPS, -t TIME or --until EXPRESSION)");
	if (!s->nargs && !c->plan)
		return pm_fail(PM_USAGE, "SENTENCE is missing (the stages of one pass, in quotes, joined by |; or --plan)");
	if (s->nargs && c->plan)
		return pm_fail(PM_USAGE, "--plan makes the sentence, and here is one (leave out one of them)");
	if (pm_given(s, "accuracy") && !c->plan)
		return pm_fail(PM_USAGE, "--accuracy belongs to --plan");
	return 0;
}

static int whole(struct pm_stage *s) { return pm_loop_run(s, s->config); }

#define AT(member) offsetof(struct pm_loop, member)
static const char *const engines[] = {"fused", "pipes", NULL};
static const struct pm_option options[] = {
	{"steps", 'n', PM_INTEGER, "steps", NULL, 0, 1e15, NULL, "full steps, counted from the beginning, also after --resume", true, AT(steps)},
	{"time", 't', PM_REAL, "time", NULL, 0, 0, NULL, "stop at the first step with time >= T - dt/2", true, AT(time)},
	{"until", 0, PM_TEXT, "EXPRESSION", NULL, 0, 0, NULL,
		"stop at the first step where this is true of diag's columns; NAME0 is the value at the beginning: 'energy > 10*energy0'", true, AT(until)},
	{"plan", 0, PM_FLAG, "", NULL, 0, 0, NULL, "without SENTENCE: run what the first frame calls for (see plan)", true, AT(plan)},
	{"accuracy", 0, PM_REAL, "", "0.01", 1e-12, 1, NULL, "with --plan: relative changes below this are negligible", true, AT(accuracy)},
	{"every", 0, PM_INTEGER, "steps", NULL, 1, 1e15, NULL, "write the beginning, every step that is a multiple of N, and the last", true, AT(every)},
	{"engine", 0, PM_WORD, "", "fused", 0, 0, engines, "run the words in one process, or as long-lived processes on pipes", true, AT(engine)},
	{"checkpoint", 0, PM_TEXT, "FILE", NULL, 0, 0, NULL, "keep the frame last written in FILE, and on SIGINT and SIGTERM", true, AT(checkpoint)},
	{"resume", 0, PM_TEXT, "FILE", NULL, 0, 0, NULL, "go on from a checkpoint instead of standard input", true, AT(resume)},
	{"other-plans", 0, PM_FLAG, "", NULL, 0, 0, NULL, "let --resume go on where transforms are planned otherwise than before (the bytes may differ)", true,
		AT(other_plans)},
	{"moves", 0, PM_LIST, "", NULL, 0, 0, NULL, "foreign words that change state and are left out of priming", true, AT(moves)},
	{0},
};
static const struct pm_example examples[] = {
	{"a star cluster on a mesh, a frame every 10 steps",
		"pinit plummer -n 1000 | cycle -n 20 --every 10 'push kick/2 drift | p2m -n 32 | poisson-fft | mgrad | m2p | push kick/2' | diag"},
	{"until a cold cluster has fallen in", "pinit cold-sphere -n 200 | cycle -n 500 --until 'virial_ratio > 1' 'push kick/2 drift | pp --potential | push kick/2' | diag --columns step,time,virial_ratio"},
	{"what the scene calls for", "pinit taylor-green-2d --cells 16 | cycle -n 5 --plan | p2m | diag"},
	{"one orbit by direct summation", "pinit two-body | cycle -n 100 'push kick/2 drift | pp | push kick/2' | diag"},
	{0},
};
const struct pm_tool tool_cycle = {
	.name = "cycle",
	.summary = "run a sentence of stages again and again, one step after the other",
	.about = "The sentence is a pipeline in quotes: words and quotes as in the shell, without expansion. If its first push needs a force that the frame does "
		 "not have, the words that make fields run once first (priming). A word that is not of pmpipe runs as a process; see docs/stage.md.",
	.kind = PM_FILTER,
	.config = sizeof(struct pm_loop),
	.options = options,
	.arguments = "SENTENCE",
	.arguments_text = "the stages of one pass, in quotes, joined by |",
	.least = 0,
	.most = 1,
	.examples = examples,
	.begin = begin,
	.whole = whole,
};
