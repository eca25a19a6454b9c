/* cycle: runs a sentence repeatedly on a frame, once per time step (lib/cycle/loop.c).
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
		return pm_fail(PM_USAGE, "--plan makes the sentence, but a SENTENCE is given too (leave out one of them)");
	if (pm_given(s, "every") && pm_given(s, "every-time"))
		return pm_fail(PM_USAGE, "--every counts steps and --every-time counts time (leave out one of them)");
	if (c->exact && isnan(c->time))
		return pm_fail(PM_USAGE, "--exact belongs to -t TIME");
	if (pm_given(s, "accuracy") && !c->plan)
		return pm_fail(PM_USAGE, "--accuracy belongs to --plan");
	if (pm_given(s, "again") && !c->plan)
		return pm_fail(PM_USAGE, "--again belongs to --plan");
	if (pm_given(s, "again") && c->exact)
		return pm_fail(PM_USAGE, "--exact and --again both choose the step (with --again a step that is changed divides the time to the end)");
	return 0;
}

static int whole(struct pm_stage *s) { return pm_loop_run(s, s->config); }

static const char *const engines[] = {"fused", "pipes", NULL};
static const char *const stores[] = {"all", "f32", NULL};
#define AT(member) .offset = offsetof(struct pm_loop, member)
#define AT_KEPT(member) AT(output.kept.member)
static const struct pm_option options[] = {
	{.name = "steps", .letter = 'n', .kind = PM_INTEGER, .unit = "steps", .high = 1e15, .cosmetic = true, AT(steps),
		.text = "full steps, counted from the beginning, also after --resume"},
	{.name = "time", .letter = 't', .kind = PM_REAL, .unit = "time", .cosmetic = true, AT(time), .text = "stop at the first step with time >= T - dt/2"},
	{.name = "exact", .kind = PM_FLAG, .cosmetic = true, AT(exact), .text = "with -t: end at exactly that time, by a shorter last step if it needs one"},
	{.name = "until", .kind = PM_TEXT, .unit = "EXPRESSION", .cosmetic = true, AT(until),
		.text = "stop at the first step at which this expression in the columns of diag is true; NAME0 is the value at the beginning: 'energy > "
			"10*energy0'"},
	{.name = "plan", .kind = PM_FLAG, .cosmetic = true, AT(plan), .text = "without SENTENCE: run the sentence that plan chooses for the first frame"},
	{.name = "accuracy", .kind = PM_REAL, .fallback = "0.01", .low = 1e-12, .high = 1, .cosmetic = true, AT(accuracy),
		.text = "with --plan: effects that change the result by less than this (relative) are left out"},
	{.name = "again", .kind = PM_INTEGER, .unit = "steps", .low = 1, .high = 1e15, .cosmetic = true, AT(again),
		.text = "with --plan: decide anew every N steps (50 is usual) and when speed, force or size of the frame change much"},
	{.name = "every", .kind = PM_INTEGER, .unit = "steps", .low = 1, .high = 1e15, .cosmetic = true, AT(every),
		.text = "write the initial frame, every step that is a multiple of N, and the last"},
	{.name = "every-time", .kind = PM_REAL, .unit = "time", .low = 1e-300, .high = 1e300, .cosmetic = true, AT(interval),
		.text = "instead at the multiples of this time: within a step of push rk45 --dense, else at the nearest step"},
	PM_SELECTION_ROWS(AT_KEPT, 0),
	{.name = "store", .kind = PM_LIST, .choices = stores, .cosmetic = true, AT(output.store),
		.text = "write everything (all), and real numbers in single precision (f32); default: types as they are, without what mgrad made of the "
			"potential"},
	{.name = "engine", .kind = PM_WORD, .fallback = "fused", .choices = engines, .cosmetic = true, AT(engine),
		.text = "run the words in one process, or as long-lived processes on pipes"},
	{.name = "checkpoint", .kind = PM_TEXT, .unit = "FILE", .cosmetic = true, AT(checkpoint),
		.text = "keep the whole frame of the step last written in FILE, also on SIGINT, SIGTERM and SIGHUP"},
	{.name = "checkpoint-every", .kind = PM_TEXT, .unit = "STEPS|TIME", .cosmetic = true, AT(checkpoint_every),
		.text = "instead with every frame: after this number of steps, or this wall time (30s, 10m, 2h), and at the end"},
	{.name = "resume", .kind = PM_TEXT, .unit = "FILE", .cosmetic = true, AT(resume), .text = "continue from a checkpoint instead of standard input"},
	{.name = "other-plans", .kind = PM_FLAG, .cosmetic = true, AT(other_plans),
		.text = "allow --resume with other FFTW plans than in the checkpoint (results may differ by round-off)"},
	{.name = "moves", .kind = PM_LIST, .cosmetic = true, AT(moves), .text = "foreign words that change state; they do not run when the sentence is primed"},
	{0},
};
static const struct pm_example examples[] = {
	{"a star cluster on a mesh, a frame every 10 steps",
		"pinit plummer -n 1000 | cycle -n 20 --every 10 'push kick/2 drift | p2m -n 32 | poisson-fft | mgrad | m2p | push kick/2' | diag"},
	{"until a cold cluster has collapsed", "pinit cold-sphere -n 200 | cycle -n 500 --until 'virial_ratio > 1' 'push kick/2 drift | pp --potential | "
		"push kick/2' | diag --columns step,time,virial_ratio"},
	{"the sentence that plan chooses", "pinit taylor-green-2d --cells 32 | cycle -n 5 --plan | p2m | diag"},
	{"one orbit by direct summation", "pinit two-body | cycle -n 100 'push kick/2 drift | pp | push kick/2' | diag"},
	{0},
};
const struct pm_tool tool_cycle = {
	.name = "cycle",
	.summary = "run a sentence repeatedly, once per time step",
	.about = "The sentence is a pipeline in quotes: words and quotes as in the shell, without expansion. If its first push needs a force that the frame "
		"does not have, the words that make fields run once first (priming). A word that does not belong to pmpipe runs as a process; see "
		"docs/stage.md. Frames are written without the field that mgrad makes of the law's potential (g, E, u), which diag and a further cycle do "
		"not need; --store all writes it too. --set, --mesh, --field and --drop choose what is written, as in sel. Checkpoints are whole.",
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
