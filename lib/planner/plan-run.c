/* Sentences run on copies of a frame, for what a plan measures. SPDX-License-Identifier: GPL-3.0-or-later */
#include "planner/plan.h"
#include "sentence/sentence.h"
#include "stream/run.h"

struct pm_frame *pm_plan_bare(const struct pm_frame *f)
{
	struct pm_frame *copy = pm_frame_copy(f);
	const unsigned roles = 1u << PM_CHANGE | 1u << PM_DERIVED;
	if (!copy)
		return NULL;
	pm_drops_roles(copy, NULL, roles);
	for (size_t i = 0; i < copy->nsets; i++)
		pm_drops_roles(copy, copy->sets[i]->name, roles);
	return pm_frame_settle(copy) ? pm_frame_free(copy) : copy;
}

static int prime(struct pm_sentence *s, struct pm_frame **f) { return pm_sentence_needs_priming(s, *f) ? pm_sentence_prime(s, f) : 0; }

/* One step, which may take several passes. */
static int step(struct pm_sentence *s, struct pm_frame **f)
{
	const int64_t before = (*f)->step;
	int status = prime(s, f);
	for (int pass = 0; pass < 16 && !status && (*f)->step == before; pass++)
		status = pm_sentence_pass(s, f);
	return status || (*f)->step > before ? status : pm_fail(PM_USAGE, "the sentence completes no step");
}

/* Adds sign times the accumulated seconds of each word. */
static void clock_words(const struct pm_sentence *s, double sign, double *seconds)
{
	for (int k = 0; seconds && k < PM_PLAN_WORDS && pm_sentence_stage(s, k); k++)
		seconds[k] += sign * pm_sentence_stage(s, k)->seconds;
}

/* Repeats the failure message after the clean-up, with the sentence. */
static struct pm_frame *failed(struct pm_frame *f, struct pm_sentence *s, const char *sentence, int status)
{
	char why[1024];
	snprintf(why, sizeof why, "%s", pm_message());
	pm_sentence_free(s);
	pm_frame_free(f);
	pm_fail(-status, "%s (of '%s')", why, sentence);
	return NULL;
}

/* A trial prints no notes: they would be read as those of a run. It begins without the freed blocks of the trial before, which had other sizes. */
static struct pm_sentence *silent(const char *sentence)
{
	pm_memory_release();
	const struct pm_stage quiet = {.quiet = true};
	struct pm_sentence *s = pm_sentence_new(sentence, true, NULL);
	if (s)
		pm_sentence_notes(s, &quiet);
	return s;
}

struct pm_frame *pm_plan_run(const struct pm_frame *f, const char *sentence, int steps, double *seconds)
{
	struct pm_sentence *s = silent(sentence);
	struct pm_frame *g = s ? pm_plan_bare(f) : NULL;
	int status = g ? prime(s, &g) : pm_failed();
	for (int k = 0; k < PM_PLAN_WORDS && seconds; k++)
		seconds[k] = 0;
	for (int i = 0; i < steps && !status; i++) {
		if (i + 1 == steps)
			clock_words(s, -1, seconds);
		status = step(s, &g);
	}
	if (!status)
		clock_words(s, 1, seconds);
	if (status)
		return failed(g, s, sentence, status);
	pm_sentence_free(s);
	return g;
}

struct pm_frame *pm_plan_prime(const struct pm_frame *f, const char *sentence)
{
	struct pm_sentence *s = silent(sentence);
	struct pm_frame *g = s ? pm_plan_bare(f) : NULL;
	int status = g ? pm_sentence_prime(s, &g) : pm_failed();
	if (status)
		return failed(g, s, sentence, status);
	pm_sentence_free(s);
	return g;
}

struct pm_frame *pm_plan_force(const struct pm_frame *f, const char *sentence)
{
	struct pm_frame *g = pm_plan_prime(f, sentence);
	if (!g)
		return NULL;
	pm_drops_roles(g, NULL, 1u << PM_DERIVED);
	return pm_frame_settle(g) ? pm_frame_free(g) : g;
}
