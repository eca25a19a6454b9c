/* A stage made from words, and run on a frame in memory: the part of a run that is the same in every engine.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/status-line.h"
#include "stage/internal.h"
#include "stream/run.h"
#include "stage/apply.h"
#include "world/world.h"

static bool timed; /* some stage of this process has --timing */

/* The clock of the processors is a call of the system each time, a quarter of the time of a step of ten bodies, and --timing alone wants it. */
struct pm_clock pm_work_clock(void) { return timed ? pm_clock() : (struct pm_clock){.wall = pm_seconds()}; }

struct pm_stage *pm_stage_free(struct pm_stage *s)
{
	if (!s)
		return NULL;
	if (s->tool->free && s->state)
		s->tool->free(s);
	if (s->run) {
		pm_reader_close(s->run->reader);
		for (int i = 0; i < s->run->ncopies; i++)
			free(s->run->copies[i]);
	}
	json_decref(s->entry);
	free(s->config), free(s->state), free((void *)s->args), free(s->word), free(s->run), free(s);
	return NULL;
}

struct pm_stage *pm_stage_make(const struct pm_tool *tool, int argc, char **argv, int *status)
{
	struct pm_stage *s = calloc(1, sizeof *s);
	if (!s) {
		*status = pm_no_memory();
		return NULL;
	}
	s->tool = tool;
	s->kind = tool->kind;
	s->config = calloc(1, tool->config + 1);
	s->args = calloc((size_t)argc + 1, sizeof *s->args);
	s->run = calloc(1, sizeof *s->run);
	if (!s->config || !s->args || !s->run) {
		*status = pm_no_memory();
		return s;
	}
	s->argc = argc;
	s->argv = argv;
	s->run->began = pm_clock();
	s->entry = json_pack("{s:s,s:s,s:{}}", "program", tool->name, "version", PM_VERSION, "options");
	*status = pm_options_parse(s, argc, argv);
	s->verbose = s->run->common.verbose;
	s->quiet = s->run->common.quiet;
	timed |= s->run->common.timing != NULL;
	if (s->run->common.no_history) {
		json_decref(s->entry);
		s->entry = NULL;
	}
	return s;
}

int pm_stage_begin(struct pm_stage *s)
{
	if (s->run->common.threads > 0)
		pm_threads_use((int)s->run->common.threads);
	s->state = calloc(1, s->tool->state + 1);
	if (!s->state)
		return pm_no_memory();
	int status = s->tool->begin ? s->tool->begin(s) : 0;
	s->setup += pm_seconds() - s->run->began.wall;
	return status;
}

struct pm_stage *pm_stage_new(const struct pm_tool *tool, int argc, char **argv)
{
	int status = 0;
	struct pm_stage *s = pm_stage_make(tool, argc, argv, &status);
	if (s && !status)
		status = pm_stage_begin(s);
	return status ? pm_stage_free(s) : s;
}

int pm_stage_declare(struct pm_stage *s, struct pm_frame *f)
{
	double t = pm_seconds();
	int status = s->tool->declare ? s->tool->declare(s, f) : 0;
	s->setup += pm_seconds() - t;
	return status;
}

int pm_stage_frame(struct pm_stage *s, struct pm_frame *f)
{
	struct pm_clock began = pm_work_clock();
	const bool apart = pm_world_apart(true);
	const int status = s->tool->frame(s, f);
	pm_world_apart(apart);
	pm_work_since(s, began);
	return status;
}

void pm_history_add(struct pm_stage *s, struct pm_frame *f)
{
	size_t i;
	json_t *e;
	if (!s->entry)
		return;
	json_array_foreach(f->history, i, e) if (json_equal(e, s->entry))
		return;
	json_array_append_new(f->history, json_deep_copy(s->entry));
}

static json_t *own_report(const struct pm_stage *s, struct pm_frame *f)
{
	json_t *mine = json_object_get(f->report, s->word);
	if (!mine) {
		mine = json_object();
		json_object_set_new(f->report, s->word, mine);
	}
	return mine;
}

void pm_report(const struct pm_stage *s, struct pm_frame *f, const char *key, double value)
{
	json_object_set_new(own_report(s, f), key, isfinite(value) ? json_real(value) : json_string(isnan(value) ? "nan" : value > 0 ? "inf" : "-inf"));
}

void pm_report_sum(const struct pm_stage *s, struct pm_frame *f, const char *key, double value)
{
	pm_report(s, f, key, json_number_value(json_object_get(own_report(s, f), key)) + value);
}

void pm_report_count(const struct pm_stage *s, struct pm_frame *f, const char *key, uint64_t count)
{
	json_t *mine = own_report(s, f);
	json_object_set_new(mine, key, json_integer(json_integer_value(json_object_get(mine, key)) + (json_int_t)count));
}

void pm_report_text(const struct pm_stage *s, struct pm_frame *f, const char *key, const char *value)
{
	json_object_set_new(own_report(s, f), key, json_string(value));
}

static void say(const struct pm_stage *s, const char *format, va_list ap, const char *more)
{
	pm_status_clear();
	fprintf(stderr, "%s: ", s->tool->name);
	vfprintf(stderr, format, ap);
	fprintf(stderr, "%s\n", more);
}

void pm_stage_no_entry(struct pm_stage *s)
{
	json_decref(s->entry);
	s->entry = NULL;
}

void pm_say(const struct pm_stage *s, const char *format, ...)
{
	va_list ap;
	va_start(ap, format);
	if (s->verbose && !s->trial)
		say(s, format, ap, "");
	va_end(ap);
}

void pm_note(const struct pm_stage *s, const char *format, ...)
{
	va_list ap;
	va_start(ap, format);
	if (!s->quiet && !s->trial)
		say(s, format, ap, "");
	va_end(ap);
}

void pm_tell_once(struct pm_stage *s, const char *format, ...)
{
	va_list ap;
	int k = 0;
	while (k < PM_TOLD_MOST && s->told[k] && s->told[k] != format)
		k++;
	if (s->trial || k == PM_TOLD_MOST || s->told[k])
		return;
	s->told[k] = format; /* a note is known by its text in the program */
	va_start(ap, format);
	if (!s->quiet)
		say(s, format, ap, "");
	va_end(ap);
}

int pm_idle(struct pm_stage *s, const char *format, ...)
{
	va_list ap;
	va_start(ap, format);
	if (s->verbose && !s->trial && !s->idle)
		say(s, format, ap, ": nothing to do, the frame is passed on unchanged");
	s->idle |= !s->trial;
	va_end(ap);
	return PM_PASS;
}

void pm_setup_since(struct pm_stage *s, struct pm_clock began)
{
	struct pm_clock now = pm_work_clock();
	s->setup += now.wall - began.wall;
	s->seconds -= now.wall - began.wall; /* the total time of frame() is added when it ends */
	s->processor -= timed ? now.processor - began.processor : 0;
}

void pm_work_since(struct pm_stage *s, struct pm_clock began)
{
	struct pm_clock now = pm_work_clock();
	s->seconds += now.wall - began.wall;
	s->processor += timed ? now.processor - began.processor : 0;
}

const struct pm_tool *pm_tool_find(const char *name)
{
	for (int i = 0; pm_tools && pm_tools[i]; i++)
		if (!strcmp(pm_tools[i]->name, name))
			return pm_tools[i];
	return NULL;
}
