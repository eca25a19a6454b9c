/* Sentences run on copies of a frame, for what a plan measures. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>
#include <time.h>

#include "planner/plan-compare.h"
#include "sentence/sentence.h"
#include "stream/frame-time.h"
#include "stream/later.h"
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

static struct pm_frame *ended(struct pm_frame *g, struct pm_sentence *s, const char *sentence, int status)
{
	if (status)
		return failed(g, s, sentence, status);
	pm_sentence_free(s);
	return g;
}

struct pm_frame *pm_plan_run(const struct pm_frame *f, const char *sentence, int steps)
{
	struct pm_sentence *s = silent(sentence);
	struct pm_frame *g = s ? pm_plan_bare(f) : NULL;
	int status = g ? pm_sentence_ready(s, &g) : pm_failed();
	for (int i = 0; i < steps && !status; i++)
		status = pm_sentence_step(s, &g);
	return ended(g, s, sentence, status);
}

struct pm_frame *pm_plan_run_until(const struct pm_frame *f, const char *sentence, double time, size_t *passes)
{
	struct pm_sentence *s = silent(sentence);
	struct pm_frame *g = s ? pm_plan_bare(f) : NULL;
	int status = g ? pm_sentence_ready(s, &g) : pm_failed();
	while (!status && *passes && fabs(g->time - time) > 1e-9 * fabs(g->dt)) {
		status = pm_sentence_pass(s, &g);
		--*passes;
	}
	return ended(g, s, sentence, status);
}

/* ---- timed ---- */

/* Wall, all processors, and the thread that leads: on a quiet machine it works all the time. */
struct clocks {
	struct pm_clock c;
	double lead;
};

static struct clocks now(void)
{
	struct timespec t;
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
	return (struct clocks){.c = pm_clock(), .lead = (double)t.tv_sec + 1e-9 * (double)t.tv_nsec};
}

/* Adds the accumulated seconds of each word, times `by`. */
static void clock_words(const struct pm_sentence *s, double by, double seconds[PM_PLAN_WORDS])
{
	for (int k = 0; k < PM_PLAN_WORDS && pm_sentence_stage(s, k); k++)
		seconds[k] += by * pm_sentence_stage(s, k)->seconds;
}

/* Adds a block of n steps, and its clocks to sum. */
static int block(struct pm_sentence *s, struct pm_frame **g, int n, struct pm_plan_timing *t, struct clocks *sum)
{
	const struct clocks a = now();
	int status = 0;
	memset(t->word[t->blocks], 0, sizeof t->word[t->blocks]);
	clock_words(s, -1. / n, t->word[t->blocks]);
	for (int i = 0; i < n && !status; i++)
		status = pm_sentence_step(s, g);
	clock_words(s, 1. / n, t->word[t->blocks]);
	const struct clocks b = now();
	t->wall[t->blocks++] = (b.c.wall - a.c.wall) / n;
	sum->c.wall += b.c.wall - a.c.wall;
	sum->c.processor += b.c.processor - a.c.processor;
	sum->lead += b.lead - a.lead;
	t->steps += n, t->timed += n;
	return status;
}

/* [s] a block is not shorter, since clocks and interruptions cost microseconds; enough for five blocks; enough for two, and for one. */
static const double shortest = 2e-3, enough = 0.1, long_enough = 1;

static bool known(const struct pm_plan_timing *t, double seconds)
{
	return t->blocks == PM_PLAN_BLOCKS || (t->blocks >= 5 && seconds > enough) || (t->blocks >= 2 && seconds > long_enough) ||
		(t->blocks && seconds > 4 * long_enough);
}

/* Blocks that were too short are done again with twice the steps, if the run has as many. */
static int blocks(struct pm_sentence *s, struct pm_frame **g, int period, double most, struct pm_plan_timing *t)
{
	struct clocks sum = {.lead = 0};
	int status = 0;
	for (int n = period; !status && !known(t, sum.c.wall) && (!t->blocks || t->steps + n <= most);) {
		status = block(s, g, n, t, &sum);
		if (t->blocks == 1 && sum.c.wall < shortest && t->steps + 10. * n <= most)
			n *= 2, t->blocks = t->timed = 0, sum = (struct clocks){.lead = 0};
	}
	t->processor = sum.c.processor / t->timed;
	t->load = sum.lead > 0 ? sum.c.wall / sum.lead : NAN;
	return status;
}

struct pm_frame *pm_plan_time(const struct pm_frame *f, const char *sentence, int period, double most, struct pm_plan_timing *t)
{
	const bool held = pm_memory_peak_begin();
	const double began = pm_seconds();
	*t = (struct pm_plan_timing){.steps = 1};
	struct pm_sentence *s = silent(sentence);
	struct pm_frame *g = s ? pm_plan_bare(f) : NULL;
	int status = g ? pm_sentence_ready(s, &g) : pm_failed();
	status = status ? status : pm_sentence_step(s, &g);
	t->first = pm_seconds() - began;
	status = status ? status : blocks(s, &g, period, most, t);
	t->peak = held ? pm_memory_peak() : NAN;
	return ended(g, s, sentence, status);
}

/* ---- fields alone ---- */

struct pm_frame *pm_plan_prime(const struct pm_frame *f, const char *sentence)
{
	struct pm_sentence *s = silent(sentence);
	struct pm_frame *g = s ? pm_plan_bare(f) : NULL;
	return ended(g, s, sentence, g ? pm_sentence_prime(s, &g) : pm_failed());
}

/* What is left to be made holds all it is made from, and there will be more such frames at a time. */
static int bring(const struct pm_frame *f)
{
	int status = 0;
	for (size_t i = 0; i < f->nfields && !status; i++)
		status = pm_field_later_of(f->fields[i]) ? pm_held_bring(f->fields[i]) : 0;
	return status;
}

struct pm_frame *pm_plan_force(const struct pm_frame *f, const char *sentence)
{
	struct pm_frame *g = pm_plan_prime(f, sentence);
	if (!g)
		return NULL;
	pm_drops_roles(g, NULL, 1u << PM_DERIVED);
	return pm_frame_settle(g) || bring(g) ? pm_frame_free(g) : g;
}

struct pm_frame *pm_plan_pass(const struct pm_frame *f, const char *words)
{
	struct pm_sentence *s = silent(words);
	struct pm_frame *g = s ? pm_plan_bare(f) : NULL;
	return ended(g, s, words, g ? pm_sentence_pass(s, &g) : pm_failed());
}

void pm_plan_span_free(struct pm_plan_span *r)
{
	r->half = pm_frame_free(r->half);
	r->end = pm_frame_free(r->end);
}

int pm_plan_run_span(const struct pm_frame *f, const char *sentence, double middle, double to, int64_t most, struct pm_plan_span *r)
{
	struct pm_sentence *s = silent(sentence);
	const double back = to < f->time ? -1 : 1;
	*r = (struct pm_plan_span){.end = s ? pm_plan_bare(f) : NULL};
	int status = r->end ? pm_sentence_ready(s, &r->end) : pm_failed();
	for (bool there = false; !status && !there; r->steps++) {
		if (back * (to - r->end->time) < fabs(r->end->dt) * (1 - 1e-6)) /* steps that a word chooses end there too */
			pm_frame_dt_set(r->end, to - r->end->time);
		status = pm_sentence_step(s, &r->end);
		const double left = back * (to - r->end->time), near = 1e-6 * fabs(r->end->dt);
		if (!status && !r->half && back * (middle - r->end->time) <= near)
			status = (r->half = pm_plan_bare(r->end)) ? 0 : pm_failed();
		there = left <= near || r->steps + 1 >= most;
	}
	struct pm_frame *bare = status ? NULL : pm_plan_bare(r->end); /* without the meshes of its last force */
	status = status || bare ? status : pm_failed();
	if (status) {
		pm_frame_free(r->half);
		failed(r->end, s, sentence, status);
		*r = (struct pm_plan_span){.end = NULL};
		return pm_failed();
	}
	pm_sentence_free(s);
	pm_frame_free(r->end);
	r->end = bare;
	return 0;
}
