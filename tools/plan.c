/* plan: the sentence for a frame, with the reason of every word; its cost; and with --check a test of each decision (lib/planner/plan.c, lib/effect).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "planner/plan.h"
#include "trial/trial.h"

struct config {
	struct pm_plan_choice choice;
	bool check, sentence, no_cost;
	int64_t steps;
	const char *format, *instead, *within;
};

struct state {
	uint64_t frames; /* printed */
};

static int begin(struct pm_stage *s)
{
	struct config *o = s->config;
	if (o->within && pm_given(s, "accuracy"))
		return pm_fail(PM_USAGE, "--within finds the accuracy (leave out --accuracy)");
	if (o->within && pm_plan_budget(o->within, &o->choice.within))
		return -PM_USAGE;
	const char *stray = pm_given(s, "steps") ? "-n belongs to --check (the end of the run is -t)" : *o->instead ? "--instead belongs to --check" : NULL;
	if (stray && !o->check)
		return pm_fail(PM_USAGE, "%s", stray);
	for (int i = 0; i < o->choice.on.n; i++)
		for (int k = 0; k < o->choice.off.n; k++)
			if (!strcmp(o->choice.on.item[i], o->choice.off.item[k]))
				return pm_fail(PM_USAGE, "'%s' is both --on and --off", o->choice.on.item[i]);
	return 0;
}

/* Reads all data. */
static int declare(struct pm_stage *s, struct pm_frame *f)
{
	(void)s;
	for (size_t i = 0; i < f->nfields; i++)
		if (!pm_reads(f, f->fields[i]->on, f->fields[i]->name))
			return -PM_DATA;
	return PM_HOLD;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct config *o = s->config;
	struct state *state = s->state;
	struct pm_plan p;
	o->choice.cost = !o->no_cost && !o->sentence && !o->check;
	if ((o->choice.time - f->time) * (f->dt < 0 ? -1 : 1) < 0)
		return pm_fail(PM_DATA, "-t %g is before the time of the frame, %g (-t is when the run ends, not how long it is)", o->choice.time, f->time);
	int status = o->within ? pm_plan_within(f, &o->choice, &p) : pm_plan_frame(f, &o->choice, &p);
	if (status)
		return status;
	if (state->frames++ && !o->sentence && strcmp(o->format, "json"))
		putchar('\n');
	if (o->check)
		return pm_trial_prove(stdout, f, &p, pm_given(s, "steps") ? o->steps : 0, *o->instead ? o->instead : NULL, !strcmp(o->format, "json"));
	if (o->sentence) {
		puts(p.sentence);
		if (!*p.refused) /* that is the tool's last line */
			pm_plan_warn(&p, "plan", stderr);
	} else if (!strcmp(o->format, "json"))
		pm_plan_print_json(stdout, &p, o->choice.cost);
	else
		pm_plan_print(stdout, &p, o->choice.cost);
	return *p.refused ? pm_fail(PM_NUMERICS, "%s", p.refused) : 0;
}

static const char *const formats[] = {"text", "json", NULL};
static const struct pm_option options[] = {
	{.name = "accuracy", .kind = PM_REAL, .fallback = "0.01", .low = 1e-12, .high = 1, PM_AT(choice.accuracy),
		.text = "relative changes below this are negligible; determines kernel, mesh and step too"},
	{.name = "within", .kind = PM_TEXT, .unit = "TIME", PM_AT(within), .text = "in place of --accuracy: the best run of this time here, as 60s"},
	{.name = "time", .letter = 't', .kind = PM_REAL, .unit = "time", PM_AT(choice.time), .text = "end of the run, as cycle -t (default: a hundred steps)"},
	{.name = "on", .kind = PM_LIST, .unit = "EFFECT", .choices = pm_effect_names, PM_AT(choice.on), .text = "always include these effects"},
	{.name = "off", .kind = PM_LIST, .unit = "EFFECT", .choices = pm_effect_names, PM_AT(choice.off), .text = "never include these effects"},
	{.name = "check", .kind = PM_FLAG, PM_AT(check),
		.text = "test every effect and every choice (step, mesh, kernel ...) by runs without it; exit 3 if the accuracy is missed"},
	{.name = "steps", .letter = 'n', .kind = PM_INTEGER, .unit = "steps", .low = 1, .high = 1e9, PM_AT(steps),
		.text = "number of steps of --check (default: the run, if that is affordable)"},
	{.name = "instead", .kind = PM_TEXT, .unit = "SENTENCE", .fallback = "", PM_AT(instead), .text = "--check tests this sentence, not plan's"},
	{.name = "sentence", .kind = PM_FLAG, PM_AT(sentence), .text = "print only the sentence, for cycle"},
	{.name = "no-cost", .kind = PM_FLAG, PM_AT(no_cost), .text = "omit measured seconds, so that the output is reproducible"},
	{.name = "format", .kind = PM_WORD, .fallback = "text", .choices = formats, PM_AT(format), .text = "text, or one JSON object per line"},
	{0},
};
static const struct pm_example examples[] = {
	{"The sentence for a shear layer", "pinit shear-layer --cells 32 --nu 1e-4 | plan"},
	{"Run the sentence", "pinit two-body >start; cycle -n 10 \"$(plan --sentence <start)\" <start | diag"},
	{0},
};
const struct pm_tool tool_plan = {
	.name = "plan",
	.summary = "choose a sentence for a frame and give the reason of every word",
	.about = "Every effect is decided from numbers of the frame: it is included if leaving it out would change the result by more than --accuracy "
		"within the time of the run. An effect that is needed and has no word yet is named. `cycle --plan` runs the sentence. See docs/plan.md.",
	.kind = PM_SINK,
	.reads = "everything",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
