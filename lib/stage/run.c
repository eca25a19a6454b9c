/* A stage as a process in a pipe: reads a stream, writes one, prints an error in one line, and passes it on to the following words.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/rounding.h"
#include "stage/file-operands.h"
#include "stage/internal.h"
#include "stage/ranks.h"
#include "stream/hand-over.h"
#include "stream/parts.h"
#include "stream/run.h"
#include "stage/apply.h"
#include "stage/divided.h"
#include "world/launch.h"
#include "world/world.h"

struct pm_reader *pm_stage_reader(struct pm_stage *s)
{
	if (!s->run->reader)
		s->run->reader = s->files && s->nargs ? pm_operands_open(s) : pm_h5_pipe_open(s->run->common.input);
	return s->run->reader;
}

struct pm_writer *pm_stage_writer(struct pm_stage *s)
{
	const char *path = s->run->common.output;
	if (!s->run->writer)
		s->run->writer = pm_h5_pipe_is(path) ? pm_h5_pipe_write(path, &s->run->rest) : pm_writer_open(path);
	return s->run->writer;
}

/* Several ranks could share the frame, whose header has been read. What reads the output of a pipe sees an abort behind the data that it would see alone, so
 * there the frame goes through rank 0. */
static bool shared(struct pm_stage *s, const struct pm_writer *w, const struct pm_frame *f)
{
	if (pm_world_size() == 1 || !s->tool->divided || (w && !pm_writer_to_file(w)))
		return false;
	struct pm_frame *h = pm_frame_header(f);
	s->trial = true;
	const int plan = h ? pm_stage_declare(s, h) : -PM_DATA;
	const bool can = (!plan || plan == PM_HOLD) && !pm_frame_affordable(h) && pm_divided_can(s, h);
	s->trial = false;
	pm_frame_free(h);
	return can;
}

static int share_frame(struct pm_stage *s, struct pm_reader *r, struct pm_writer *w, struct pm_frame *f)
{
	int status = pm_read_payload(r, f, true, NULL);
	status = status ? status : pm_stage_apply(s, f);
	if (status || !w)
		return status < 0 ? status : 0;
	pm_history_add(s, f);
	return pm_write_frame(w, f);
}

/* One frame through a filter. The header goes out before the data are read, unless it depends on them. */
static int filter_frame(struct pm_stage *s, struct pm_reader *r, struct pm_writer *w, struct pm_frame *f)
{
	int plan = pm_stage_declare(s, f), status = plan < 0 ? plan : 0;
	bool hold = plan == PM_HOLD, emit = w && plan != PM_SKIP;
	if (status)
		return status;
	pm_history_add(s, f);
	status = pm_frame_affordable(f);
	pm_buffers_share(emit && pm_writer_hands(w)); /* what is read and made here is handed on */
	if (!status && emit && !hold)
		status = pm_write_header(w, f);
	if (!status)
		status = pm_read_payload(r, f, hold, emit && !hold ? w : NULL);
	if (!status && (plan == 0 || hold)) {
		status = pm_frame_ready(f);
		if (!status && s->tool->frame)
			status = pm_stage_frame(s, f);
		if (status == PM_SKIP) /* only if the header has not been written yet */
			return 0;
	}
	if (status >= 0)
		status = pm_frame_settle(f);
	if (status >= 0 && emit)
		status = hold ? pm_write_header(w, f) : 0;
	if (status >= 0 && emit)
		status = pm_write_last(w, f);
	return status < 0 ? status : 0;
}

static int run_filter(struct pm_stage *s)
{
	struct pm_reader *r = pm_stage_reader(s);
	struct pm_writer *w = s->kind == PM_FILTER ? pm_stage_writer(s) : NULL;
	if (!r || (s->kind == PM_FILTER && !w))
		return pm_failed();
	for (;;) {
		struct pm_frame *f = NULL;
		int got = pm_read_header(r, &f), status = 0;
		if (got < 0 || got == PM_GOT_EOF)
			return got;
		if (got == PM_GOT_END) {
			status = w && s->tool->flush ? s->tool->flush(s, w) : 0;
			status = w && !status ? pm_write_end(w) : status;
		} else {
			status = shared(s, w, f) ? share_frame(s, r, w, f) : filter_frame(s, r, w, f);
			pm_frame_free(f);
		}
		if (status)
			return status;
	}
}

/* By all ranks, if the word says that they can. */
static int source(struct pm_stage *s, struct pm_frame **f)
{
	if (pm_world_size() == 1 || !s->tool->divided)
		return s->tool->source(s, f);
	const bool shared = s->tool->divided(s, NULL);
	s->frames[shared]++;
	if (shared)
		return pm_divided_source(s, f);
	const bool apart = pm_world_apart(true);
	const int more = s->tool->source(s, f);
	pm_world_apart(apart);
	return more;
}

static int run_source(struct pm_stage *s)
{
	struct pm_writer *w = pm_stage_writer(s);
	struct pm_frame *f = NULL;
	int more, status = w ? 0 : pm_failed();
	while (!status) {
		struct pm_clock began = pm_work_clock();
		more = source(s, &f);
		pm_work_since(s, began);
		if (more <= 0) {
			status = more;
			break;
		}
		pm_history_add(s, f);
		status = pm_frame_settle(f);
		if (!status)
			status = pm_write_frame(w, f);
		f = pm_frame_free(f);
	}
	pm_frame_free(f);
	return status ? status : pm_write_end(w);
}

static bool print_and_go(const struct pm_tool *tool, const struct pm_common *c)
{
	if (c->help)
		pm_help(tool);
	else if (c->man)
		pm_man(tool);
	else if (c->complete)
		pm_complete(tool);
	else if (c->examples)
		pm_print_examples(tool);
	else if (c->version)
		printf("%s (pmpipe) %s\n", tool->name, PM_VERSION);
	else
		return false;
	return true;
}

/* Prints the message on stderr, and writes it to the stream as an abort for the following words. */
static void tell(struct pm_stage *s, const struct pm_tool *tool, int status)
{
	char text[2048];
	struct pm_reader *r = s ? s->run->reader : NULL;
	const char *file = s && s->files ? pm_operand_name(s) : NULL;
	bool passed_on = r && pm_reader_aborted(r), in_frame = r && !passed_on && (s->kind == PM_FILTER || s->kind == PM_SINK) && !tool->whole;
	if (passed_on)
		snprintf(text, sizeof text, "%s", pm_message());
	else if (in_frame)
		snprintf(text, sizeof text, "%s: %s%sframe %llu: %s", tool->name, file ? file : "", file ? ": " : "", (unsigned long long)pm_reader_frame(r),
			pm_message());
	else
		snprintf(text, sizeof text, "%s: %s", tool->name, pm_message());
	if (!getenv("PM_QUIET")) /* set by cycle for its processes */
		fprintf(stderr, passed_on ? "%s: stopped by %s\n" : "%.0s%s\n", tool->name, text);
	if ((s ? s->kind : tool->kind) == PM_SINK || (pm_output_is_terminal() && !(s && s->run->common.output)))
		return;
	struct pm_writer *w = s ? pm_stage_writer(s) : pm_writer_open(NULL);
	if (w)
		pm_write_abort(w, pm_exit_code(status), text);
}

/* What goes to standard output goes to a file. */
static int text_to(struct pm_run *run, const char *path)
{
	int status = pm_replace_open(&run->text, path, false);
	if (!status && dup2(run->text.fd, STDOUT_FILENO) < 0)
		status = pm_fail_errno("cannot write '%s'", path);
	return status;
}

/* The process ends within run(): by a library (libgomp, where no thread can be started), or because there is no memory. Both are said under our
 * name and down the stream. */
static struct {
	const struct pm_tool *tool; /* NULL: not within */
	struct pm_stage *stage;     /* NULL: not made yet */
	bool memory;
} running;

static void left_early(void)
{
	const struct pm_tool *tool = running.tool;
	struct pm_stage *s = running.stage;
	if (!tool)
		return;
	running.tool = NULL;
	if (!running.memory)
		pm_fail(PM_DATA, "ended by a library before it was done, its reason is above (fewer threads: --threads, OMP_NUM_THREADS; OMP_STACKSIZE)");
	tell(s, tool, -PM_DATA);
	pm_replace_abandon();
	fflush(stdout);
	pm_world_abort(PM_DATA);
	_exit(PM_DATA); /* HDF5 ends with 255 */
}

static void memory_ends(void)
{
	running.memory = true;
	if (running.tool)
		exit(PM_DATA);
	fprintf(stderr, "%s\n", pm_message()); /* behind run(), where nothing is left but to close the files */
	pm_world_abort(PM_DATA);
	_exit(PM_DATA);
}

/* jansson's functions return -1 where there is no memory, which nobody can check everywhere. */
static void *json_room(size_t bytes)
{
	void *room = malloc(bytes);
	if (!room && bytes)
		pm_no_memory();
	return room;
}

static int run(struct pm_stage *s)
{
	int status = pm_stage_begin(s);
	if (status)
		return status;
	if (s->kind == PM_SINK && pm_h5_pipe_is(s->run->common.output))
		return pm_fail(PM_USAGE, "'%s': .h5 files hold streams, but %s writes text", s->run->common.output, s->tool->name);
	if (s->kind == PM_SINK && s->run->common.output && strcmp(s->run->common.output, "-") && (status = text_to(s->run, s->run->common.output)))
		return status;
	if (s->tool->whole)
		status = s->tool->whole(s);
	else
		status = s->kind == PM_SOURCE ? run_source(s) : run_filter(s);
	if (!status && s->tool->end)
		status = s->tool->end(s);
	return status;
}

/* Rank 0, or alone. made: the status of s, with its message. */
static int lead(const struct pm_tool *tool, struct pm_stage *s, int made)
{
	int status = made;
	running.tool = tool;
	running.stage = s;
	bool printed = s && !status && print_and_go(tool, &s->run->common);
	if (s && !status && !printed)
		status = run(s);
	running.tool = NULL;
	if (!status && s && s->frames[0] + s->frames[1])
		pm_say(s, s->frames[1] ? "%d ranks share the work" : "rank 0 of %d alone does the work", pm_world_size());
	if (status < 0 && s && s->run->rest)
		status = pm_h5_pipe_reason(s->run->rest, status);
	if (status < 0)
		tell(s, tool, status);
	else if (s && !printed && pm_timing_write(s, s->run->common.timing)) {
		status = -PM_DATA;
		fprintf(stderr, "%s: %s\n", tool->name, pm_message());
	}
	if (s && s->run->writer && pm_writer_close(s->run->writer) && !status) {
		status = -PM_DATA;
		fprintf(stderr, "%s: %s\n", tool->name, pm_message());
	}
	int rest = s ? pm_h5_pipe_close(s->run->rest) : 0;
	if (rest && !status) {
		status = rest;
		fprintf(stderr, "%s: %s\n", tool->name, pm_message());
	}
	int flushed = fflush(stdout) ? pm_fail_errno("cannot write the output") : 0;
	if (s && !status && !flushed)
		flushed = pm_replace_commit(&s->run->text, false);
	if (s)
		pm_replace_drop(&s->run->text);
	if (flushed && !status) {
		status = flushed;
		fprintf(stderr, "%s: %s\n", tool->name, pm_message());
	}
	pm_stage_free(s);
	const int others = pm_ranks_end();
	if (others && !status) {
		status = others;
		fprintf(stderr, "%s: %s\n", tool->name, pm_message());
	}
	return pm_exit_code(status);
}

int pm_main(const struct pm_tool *tool, int argc, char **argv)
{
	running.tool = tool;
	json_set_alloc_funcs(json_room, free);
	pm_memory_end(memory_ends);
	signal(SIGXFSZ, SIG_IGN); /* a limit of the size of files is an error of write() */
	atexit(left_early);
	int status = pm_rounding(getenv("PM_ROUNDING"));
	const bool launched = !status && pm_launched();
	status = launched ? pm_ranks_launch() : status;
	status = launched && !status ? pm_ranks_compare(tool) : status;
	struct pm_stage *s = running.stage = status || pm_world_rank() ? NULL : pm_stage_make(tool, argc, argv, &status);
	if (s && !status && s->run->common.ranks > 0)
		status = pm_ranks_rehearse((int)s->run->common.ranks);
	if (pm_world_rank() == 0)
		return lead(tool, s, status);
	running.tool = NULL;
	s = s ? s : pm_stage_make(tool, argc, argv, &status); /* what is wrong with the options is said by rank 0 */
	if (s && !status && s->run->common.threads > 0)
		pm_threads_use((int)s->run->common.threads);
	pm_stage_free(s);
	return pm_ranks_follow(tool);
}
