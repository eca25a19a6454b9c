/* The loop of cycle. All that is written to the output is decided between steps and from the frame alone, so that every engine and a resumed run do the same.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "stage/internal.h"
#include "cycle/checkpoint.h"
#include "cycle/in-force.h"
#include "cycle/interrupt.h"
#include "cycle/missing-words.h"
#include "cycle/output.h"
#include "cycle/progress.h"
#include "cycle/run-end.h"
#include "sentence/sentence.h"
#include "cycle/until.h"
#include "cycle/dense-output.h"
#include "cycle/watch.h"

struct cycle {
	const struct pm_loop *c;
	struct pm_stage *s;
	struct pm_in_force now; /* the sentence */
	struct pm_writer *out;
	struct pm_until *until; /* NULL: none */
	struct pm_run_end end;  /* -t */
	struct pm_watch watch;  /* over the sums of strengths; not if foreign words may change state */
	int met;                /* the expression is true for this frame */
	bool judged;            /* the first frame was compared with the sentence */
	int64_t start, written; /* step at the beginning of the run; step last written */
	double began;           /* [time] at which the step under way began */
	int64_t saved;          /* step of the last checkpoint */
	struct pm_progress progress;
	struct pm_checkpoint kept;
	struct pm_output what;  /* is written of a frame */
	struct pm_frame *last;  /* the beginning of the step under way, where the sentence has processes, which may never answer; else NULL */
	json_t *before;         /* resume: the report of the checkpoint, kept until the first pass has been compared with it */
};

/* The whole frame, with what a resumed run must know: the step at the beginning, strengths, the values of --until. */
static int checkpoint(struct cycle *y, const struct pm_frame *f)
{
	struct pm_frame *copy = y->kept.name ? pm_frame_copy(f) : NULL;
	if (!copy)
		return y->kept.name ? pm_failed() : 0;
	json_object_set_new(copy->more, "cycle_start", json_integer(y->start));
	json_object_set_new(copy->more, "cycle_strengths", pm_watch_save(&y->watch));
	if (y->until)
		json_object_set_new(copy->more, "cycle_until", pm_until_save(y->until));
	const int status = pm_checkpoint_write(&y->kept, copy);
	y->saved = f->step;
	pm_frame_free(copy);
	return status;
}

/* until: said of frames that are written; not under the command line as typed, because a resumed run is typed differently. */
static void say_until(struct cycle *y, struct pm_frame *f)
{
	if (y->until)
		json_object_set_new(pm_cycle_report(f), "until", json_integer(y->met));
}

static int write_out(struct cycle *y, struct pm_frame *f)
{
	y->written = f->step;
	say_until(y, f);
	pm_progress_writes(&y->progress);
	struct pm_frame *part = pm_output_of(&y->what, y->now.words, f);
	const int status = part ? pm_write_frame(y->out, part) : pm_failed();
	pm_frame_free(part);
	return status || !pm_checkpoint_with_frames(&y->kept) ? status : checkpoint(y, f);
}

/* A frame at a time within the step that is behind. */
static int write_between(struct cycle *y, const struct pm_frame *f, double time)
{
	struct pm_frame *at = pm_dense_frame(f, time), *part = at ? pm_output_of(&y->what, y->now.words, at) : NULL;
	const int status = part ? pm_write_frame(y->out, part) : pm_failed();
	pm_frame_free(part);
	pm_frame_free(at);
	return status;
}

/* --every-time: the multiples of the interval that this step has passed. A multiple is at a step if it differs from it by rounding only; without dense
 * output it belongs to the nearest step, as the end of a run. */
static int write_multiples(struct cycle *y, struct pm_frame *f)
{
	const double interval = y->c->interval, step = f->time - y->began, half = pm_dense_has(f) ? 1e-9 * step : step / 2;
	const double from = fmin(y->began + half, f->time + half) / interval, to = fmax(y->began + half, f->time + half) / interval;
	const int64_t count = (int64_t)fmin(floor(to) - floor(from), 1e9);
	int status = 0;
	for (int64_t i = 1; i <= count && !status; i++) {
		const double time = (step > 0 ? floor(from) + (double)i : floor(to) + 1 - (double)i) * interval;
		if (pm_dense_has(f) && fabs(time - f->time) > fabs(half))
			status = write_between(y, f, time);
		else if (y->written != f->step)
			status = write_out(y, f);
	}
	return status;
}

/* A full step is behind: a frame, a checkpoint, both or none. */
static int keep(struct cycle *y, struct pm_frame *f)
{
	int status = pm_output_check(&y->what, f);
	if (!status && y->c->interval > 0)
		status = write_multiples(y, f);
	if (!status && y->c->every > 0 && f->step % y->c->every == 0)
		status = write_out(y, f);
	return status || !pm_checkpoint_due(&y->kept, f) ? status : checkpoint(y, f);
}

static bool done(const struct cycle *y, const struct pm_frame *f)
{
	if (f->substep)
		return false;
	return y->met || (y->c->steps != INT64_MIN && f->step >= y->start + y->c->steps) || pm_run_end_reached(&y->end, f);
}

/* 0 or failure; sets whether the run ends here. */
static int look(struct cycle *y, struct pm_frame *f)
{
	const int met = y->until ? pm_until_met(y->until, f) : 0;
	y->met = met > 0;
	return met < 0 ? met : 0;
}

/* The beginning of a run with --until: the sentence is primed, so that the columns can be computed. */
static int look_first(struct cycle *y, struct pm_frame **f)
{
	json_t *saved = json_incref(json_object_get((*f)->more, "cycle_until"));
	json_object_del((*f)->more, "cycle_until");
	int status = 0;
	y->met = 0;
	if (y->until && y->c->resume)
		status = pm_until_load(y->until, *f, saved);
	else if (y->until) {
		status = pm_sentence_ready(y->now.words, f);
		status = status ? status : pm_until_begin(y->until, *f);
	}
	json_decref(saved);
	return status ? status : look(y, *f);
}

/* Stages with FFTW transforms report the FFTW plans used; a resumed run must use the same ones, or its bytes would differ. */
static int same_plans(struct cycle *y, const struct pm_frame *f)
{
	const char *word;
	json_t *entry;
	int status = 0;
	json_object_foreach(y->before, word, entry)
	{
		const char *old = json_string_value(json_object_get(entry, "plan"));
		const char *now = json_string_value(json_object_get(json_object_get(f->report, word), "plan"));
		if (old && now && strcmp(old, now) && !y->c->other_plans && !status)
			status = pm_fail(PM_DATA, "'%s' uses the FFTW plans '%s', but the checkpoint was made with '%s': the bytes would differ "
				"(another FFTW or processor, or an older pmpipe; --other-plans continues)", word, now, old);
	}
	json_decref(y->before);
	y->before = NULL;
	return status;
}

static int interrupted(struct cycle *y, const struct pm_frame *f)
{
	int status = checkpoint(y, f);
	if (status)
		return status;
	return pm_fail(PM_DATA, "stopped by signal %d after step %lld%s%s", pm_interrupted(), (long long)f->step,
		y->c->checkpoint ? ", continue with --resume " : "", y->c->checkpoint ? y->c->checkpoint : "");
}

/* One pass of the sentence; writes a frame if the completed step is one to be written. */
static int pass(struct cycle *y, struct pm_frame **f)
{
	int64_t step = (*f)->step;
	int substep = (*f)->substep;
	y->began = (*f)->start;
	const bool waits = pm_sentence_waits(y->now.words);
	if (waits && !substep) {
		pm_frame_free(y->last);
		if (!(y->last = pm_frame_copy(*f)))
			return pm_failed();
	}
	pm_run_end_shorten(&y->end, *f);
	int status = pm_sentence_ready(y->now.words, f);
	if (!status)
		status = pm_sentence_pass(y->now.words, f);
	if (status && waits && pm_interrupt_gives_up() && y->last)
		return interrupted(y, y->last);
	if (status)
		return pm_fail(-status, "step %lld: %s", (long long)step + 1, pm_message());
	if (y->before && same_plans(y, *f))
		return -PM_DATA;
	if ((*f)->step == step && (*f)->substep == substep)
		return pm_fail(PM_USAGE, "the sentence has no word that completes a step (add push)");
	if ((*f)->step > step && (*f)->substep)
		return pm_fail(PM_USAGE,
			"one pass of the sentence completes a step and begins another (begin with push kick/2 drift; or write drift "
			"--open where the kick comes later)");
	if ((*f)->step > step + 1)
		return pm_fail(PM_USAGE,
			"one pass of the sentence completes %lld steps, but cycle needs one step per pass (one scheme; or half a kick before the force and "
			"half behind it: push kick/2 drift | ... | push kick/2)",
			(long long)((*f)->step - step));
	bool full = (*f)->substep == 0 && (*f)->step > step;
	pm_progress_step(&y->progress, *f);
	status = full ? pm_run_end_restore(&y->end, *f) : 0;
	status = full && !status && !y->c->moves.n ? pm_watch_step(&y->watch, *f) : status;
	status = status || !full ? status : look(y, *f);
	if (status)
		return pm_fail(-status, "step %lld: %s", (long long)(*f)->step, pm_message());
	return full ? keep(y, *f) : 0;
}

/* The beginning of a run, or of its rest. */
static void watch(struct cycle *y, struct pm_frame *f)
{
	json_t *saved = json_incref(json_object_get(f->more, "cycle_strengths"));
	json_object_del(f->more, "cycle_strengths");
	pm_watch_load(&y->watch, f, y->c->resume ? saved : NULL);
	json_decref(saved);
}

static int run_frame(struct cycle *y, struct pm_frame **f)
{
	int status = 0;
	if (!y->c->plan || !y->c->resume)
		json_object_del((*f)->more, "plan"); /* of an earlier run */
	if (y->now.words && y->now.again.every && (status = pm_in_force_finish(&y->now)))
		return status;
	status = y->now.words ? 0 : pm_in_force_plan(&y->now, *f);
	const double began = (*f)->time;
	status = status ? status : pm_run_end_check(&y->end, y->now.words);
	if (status)
		return status;
	const json_t *start = json_object_get((*f)->more, "cycle_start");
	y->start = y->c->resume ? json_integer_value(start) : (*f)->step;
	json_object_del((*f)->more, "cycle_start");
	watch(y, *f);
	y->progress = (struct pm_progress){.first = y->start, .steps = y->c->steps, .to = y->c->time};
	pm_progress_begin(&y->progress, y->s, *f);
	y->written = y->saved = -1;
	y->before = y->c->resume ? json_deep_copy((*f)->report) : NULL;
	if (!y->c->resume)
		pm_history_add(y->s, *f), pm_sentence_forces(y->now.words, *f);
	if (!y->c->resume && !y->c->plan && !y->judged && !y->s->quiet)
		pm_missing_words(y->now.words, *f, pm_in_force_end(&y->now, *f));
	y->judged = true;
	status = look_first(y, f);
	status = status ? status : pm_output_begin(&y->what, *f);
	if (!status && (y->c->every > 0 || y->c->interval > 0) && !y->c->resume) {
		status = pm_sentence_ready(y->now.words, f);
		status = status ? status : write_out(y, *f);
	}
	while (!status && !done(y, *f)) {
		status = pm_in_force_again(&y->now, f);
		status = status ? status : pass(y, f);
		if (!status && pm_interrupted() && (*f)->substep == 0)
			status = interrupted(y, *f);
	}
	pm_progress_end(&y->progress, *f);
	if (!status && pm_run_end_reached(&y->end, *f))
		pm_run_end_tell(&y->end, y->s, y->now.words, *f, (*f)->step - y->start, began);
	json_decref(y->before);
	y->before = NULL;
	status = status ? status : pm_output_check(&y->what, *f);
	if (!status && y->written != (*f)->step)
		status = write_out(y, *f);
	return !status && y->saved != (*f)->step ? checkpoint(y, *f) : status;
}

static int frames(struct cycle *y, struct pm_reader *in)
{
	for (;;) {
		struct pm_frame *f = NULL;
		int got = pm_read_frame(in, &f);
		if (got == PM_GOT_EOF || (got < 0 && pm_reader_aborted(in)))
			return got;
		if (got < 0)
			return pm_fail(-got, "frame %llu: %s", (unsigned long long)pm_reader_frame(in), pm_message());
		int status = got == PM_GOT_END ? pm_write_end(y->out) : run_frame(y, &f);
		pm_frame_free(f);
		if (status)
			return status;
	}
}

int pm_loop_run(struct pm_stage *s, const struct pm_loop *c)
{
	struct cycle y = {.c = c, .s = s, .now = {.c = c, .s = s}, .kept = {.lock = -1}, .end = {.time = c->time, .exact = c->exact}};
	struct pm_reader *in = NULL;
	int status = pm_output_init(&y.what, &c->output);
	status = status ? status : pm_checkpoint_init(&y.kept, c->checkpoint, c->checkpoint_every);
	if (!status && !c->plan)
		status = pm_in_force_speak(&y.now, s->args[0]);
	if (!status && c->until && !(y.until = pm_until_new(c->until)))
		status = pm_failed();
	if (!status) {
		if (c->resume)
			s->run->reader = pm_h5_pipe_open(c->resume);
		in = c->resume ? s->run->reader : pm_stage_reader(s);
		y.out = in ? pm_stage_writer(s) : NULL;
		status = y.out ? 0 : pm_failed();
	}
	pm_interrupt_listen();
	if (!status)
		status = frames(&y, in);
	if (!status && y.now.words)
		status = pm_sentence_end(y.now.words);
	if (!status && y.now.words)
		pm_sentence_ranks(y.now.words, s);
	if (!status && y.now.words)
		status = pm_sentence_timing(y.now.words, s->run->common.timing);
	char message[1024];
	snprintf(message, sizeof message, "%s", pm_message());
	int end = pm_sentence_free(y.now.words);
	pm_timing_whole(s);
	pm_until_free(y.until);
	pm_frame_free(y.last);
	pm_output_free(&y.what);
	pm_checkpoint_free(&y.kept);
	return status ? pm_fail(-status, "%s", message) : end;
}
