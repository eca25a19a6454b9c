/* Rank 0 sends the header as it was before declare(), the words, the division of every set in use, and which parts the fields in use are and become. All ranks
 * then do the same: declare, take their parts, check, compute, settle; and agree. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "stage/apply.h"
#include "stage/divided.h"
#include "stage/internal.h"
#include "stream/header.h"
#include "stream/limits.h"
#include "stream/parts.h"
#include "stream/run.h"
#include "world/world.h"

struct used {
	struct pm_field *field;
	uint64_t *from;
	uint64_t was, is; /* numbers of the parts before and behind the word; was 0: none before */
	bool dropped;
};

struct uses {
	size_t n;
	struct used *of;
};

/* The fields in use, in the order of the frame: the same on all ranks. */
static int uses_make(struct uses *u, struct pm_frame *f)
{
	*u = (struct uses){0, calloc(f->nfields + f->ndropped + 1, sizeof *u->of)};
	if (!u->of)
		return pm_no_memory();
	for (size_t i = 0; i < f->nfields + f->ndropped; i++) {
		struct pm_field *p = i < f->nfields ? f->fields[i] : f->dropped[i - f->nfields];
		if (!p->use)
			continue;
		p->order = (int)i;
		u->of[u->n++] = (struct used){.field = p, .dropped = i >= f->nfields};
	}
	return 0;
}

static void uses_free(struct uses *u)
{
	for (size_t i = 0; i < u->n; i++)
		free(u->of[i].from);
	free(u->of);
	u->of = NULL;
	u->n = 0;
}

static bool is_used(const struct uses *u, const struct pm_field *field)
{
	for (size_t i = 0; i < u->n; i++)
		if (u->of[i].field == field)
			return true;
	return false;
}

/* Behind frame(): the fields that it made and divided, whose parts get numbers, and those that it dropped. */
static int adopt(int status, struct uses *u, struct pm_frame *f)
{
	const size_t before = u->n;
	struct used *of = realloc(u->of, (u->n + f->nfields + 1) * sizeof *of);
	uint64_t *id = calloc(f->nfields + 1, sizeof *id);
	if (!status && !(of && id))
		status = pm_no_memory();
	u->of = of ? of : u->of;
	for (size_t i = 0; of && i < f->nfields; i++)
		if (f->fields[i]->here && !is_used(u, f->fields[i])) {
			f->fields[i]->order = (int)i;
			u->of[u->n++] = (struct used){.field = f->fields[i], .from = (uint64_t *)(uintptr_t)f->fields[i]->from};
		}
	for (size_t i = 0; i < u->n; i++)
		for (size_t k = 0; k < f->ndropped; k++)
			u->of[i].dropped |= u->of[i].field == f->dropped[k];
	status = pm_world_agree(status);
	if (!status && u->n > before) {
		for (size_t i = before; i < u->n && !pm_world_rank(); i++)
			id[i - before] = pm_parts_number();
		status = pm_world_share(status, 0, id, (u->n - before) * sizeof *id);
		for (size_t i = before; i < u->n && !status; i++)
			u->of[i].is = id[i - before];
	}
	free(id);
	return status;
}

/* On every rank: the same operations in the same order, whatever its status. */
static int run_frame(struct pm_stage *s, struct pm_frame *f, struct uses *u, int status)
{
	for (size_t i = 0; i < u->n && !status; i++)
		status = pm_field_enter(u->of[i].field, u->of[i].from);
	for (size_t i = 0; i < u->n && !status; i++)
		if (u->of[i].field->use & (PM_USE_READ | PM_USE_CHANGE) && !u->of[i].field->finite)
			status = pm_field_check(u->of[i].field, PM_DATA);
	status = status ? status : pm_frame_ready(f);
	status = pm_world_agree(status);
	if (!status) {
		struct pm_clock began = pm_work_clock();
		status = s->tool->frame(s, f);
		pm_work_since(s, began);
		status = adopt(status < 0 ? status : status > 0 ? pm_fail(PM_DATA, "a divided word cannot leave a frame out") : 0, u, f);
		if (!status)
			status = pm_world_agree(pm_frame_settle(f));
		else
			return status;
		for (size_t i = 0; i < u->n; i++)
			if (u->of[i].dropped)
				u->of[i].field = NULL; /* settled: it is gone */
	}
	return status;
}

static void sent_since(struct pm_stage *s, const struct pm_world_traffic before)
{
	const struct pm_world_traffic now = pm_world_traffic();
	s->sent[0] += now.bytes - before.bytes, s->sent[1] += now.messages - before.messages;
}

/* The same, counted. s NULL: it could not be made. */
static int run_here(struct pm_stage *s, struct pm_frame *f, struct uses *u, int status)
{
	const struct pm_world_traffic before = pm_world_traffic();
	const double seconds = s ? s->seconds : 0;
	status = run_frame(s, f, u, status);
	if (s) {
		sent_since(s, before);
		s->shared += s->seconds - seconds;
	}
	return status;
}

static void leave(struct uses *u)
{
	for (size_t i = 0; i < u->n; i++)
		if (u->of[i].field && u->of[i].field->here)
			pm_field_leave(u->of[i].field, u->of[i].from, u->of[i].is);
}

/* ---- rank 0 ---- */

char *pm_divided_header(const struct pm_stage *s, const struct pm_frame *f)
{
	if (pm_world_size() == 1 || pm_world_rank() || !s->tool->divided || !s->argv)
		return NULL;
	json_t *header = pm_header_json(f), *limits = header ? pm_limits_json(f) : NULL;
	if (header)
		json_object_del(header, "history");
	if (header)
		json_object_set_new(header, "history", json_array());
	json_t *both = header ? json_pack("{s:o,s:o}", "header", header, "limits", limits ? limits : json_object()) : NULL;
	char *text = both ? pm_json_line(both) : NULL;
	json_decref(both);
	return text;
}

bool pm_divided_can(const struct pm_stage *s, const struct pm_frame *f)
{
	bool any = false;
	for (size_t i = 0; i < f->nfields + f->ndropped; i++) {
		const struct pm_field *p = i < f->nfields ? f->fields[i] : f->dropped[i - f->nfields];
		any |= p->use != 0;
	}
	return any && s->tool->frame && s->tool->divided(s, f);
}

static int divide(struct used *u, const struct pm_frame *f)
{
	struct pm_field *p = u->field;
	if (!(u->from = pm_division_new(p->count, pm_division_grain(f, p->on))))
		return -PM_DATA;
	const bool change = p->use & PM_USE_CHANGE, copies = p->buffer && change && atomic_load(&p->buffer->users) > 1;
	int status = p->buffer ? pm_buffer_divide(p->buffer, p->components, pm_field_memory(p), u->from) : 0;
	u->was = p->buffer ? p->buffer->id : 0;
	u->is = u->was && !copies ? u->was : pm_parts_number();
	return status;
}

static json_t *words_of(const struct pm_stage *s)
{
	json_t *words = json_array();
	for (int i = 0; i < s->argc; i++)
		json_array_append_new(words, json_string(s->argv[i]));
	return words;
}

static char *request(const struct pm_stage *s, const char *header, const struct uses *u)
{
	json_t *words = words_of(s), *fields = json_array();
	for (size_t i = 0; i < u->n; i++) {
		json_t *from = json_array();
		for (int r = 0; r <= pm_world_size(); r++)
			json_array_append_new(from, json_integer((json_int_t)u->of[i].from[r]));
		json_array_append_new(fields, json_pack("{s:o,s:I,s:I,s:b}", "from", from, "was", (json_int_t)u->of[i].was, "is", (json_int_t)u->of[i].is,
			"finite", u->of[i].field->finite));
	}
	json_t *all = json_pack("{s:s,s:o,s:o,s:s}", "word", s->tool->name, "words", words, "fields", fields, "frame", header);
	char *text = all ? pm_json_line(all) : NULL;
	json_decref(all);
	return text;
}

int pm_divided_apply(struct pm_stage *s, struct pm_frame *f, const char *header)
{
	struct uses u;
	int status = uses_make(&u, f);
	for (size_t i = 0; i < u.n && !status; i++)
		status = divide(&u.of[i], f);
	char *text = status ? NULL : request(s, header, &u);
	status = status || text ? status : pm_no_memory();
	status = status ? status : pm_request_send(PM_REQUEST_APPLY, text, strlen(text));
	free(text);
	if (!status) {
		status = run_here(s, f, &u, 0);
		leave(&u);
	}
	uses_free(&u);
	return status;
}

/* ---- the other ranks ---- */

/* Stages stay, because what they keep between frames (plans) is dear. */
static struct {
	size_t n, room;
	struct pm_stage **of;
	char ***argv;
	int *argc;
} stages;

static void words_free(char **argv, int argc)
{
	for (int i = 0; argv && i < argc; i++)
		free(argv[i]);
	free(argv);
}

static bool same_words(size_t k, const json_t *words)
{
	bool same = json_array_size(words) == (size_t)stages.argc[k];
	for (int i = 0; i < stages.argc[k] && same; i++)
		same = !strcmp(stages.argv[k][i], json_string_value(json_array_get(words, (size_t)i)));
	return same;
}

static int stage_add(const struct pm_tool *tool, const json_t *words, struct pm_stage **s)
{
	const int argc = (int)json_array_size(words);
	if (stages.n == stages.room) {
		const size_t room = 2 * stages.room + 8;
		void *of = realloc(stages.of, room * sizeof *stages.of), *argv = of ? realloc(stages.argv, room * sizeof *stages.argv) : NULL;
		stages.of = of ? of : stages.of, stages.argv = argv ? argv : stages.argv;
		int *counts = argv ? realloc(stages.argc, room * sizeof *counts) : NULL;
		if (!counts)
			return pm_no_memory();
		stages.argc = counts;
		stages.room = room;
	}
	char **argv = calloc((size_t)argc + 1, sizeof *argv);
	int status = argv ? 0 : pm_no_memory();
	for (int i = 0; i < argc && !status; i++)
		status = (argv[i] = strdup(json_string_value(json_array_get(words, (size_t)i)))) ? 0 : pm_no_memory();
	*s = status ? NULL : pm_stage_make(tool, argc, argv, &status);
	if (*s && !status)
		status = pm_stage_begin(*s);
	if (status || !*s) {
		pm_stage_free(*s);
		words_free(argv, argc);
		return status ? status : pm_failed();
	}
	(*s)->quiet = true;
	(*s)->verbose = false;
	stages.of[stages.n] = *s, stages.argv[stages.n] = argv, stages.argc[stages.n] = argc;
	stages.n++;
	return 0;
}

static int stage_of(const struct pm_tool *own, const json_t *all, struct pm_stage **s)
{
	const char *name = json_string_value(json_object_get(all, "word"));
	const json_t *words = json_object_get(all, "words");
	const struct pm_tool *tool = own && !strcmp(own->name, name) ? own : pm_tool_find(name);
	for (size_t k = 0; k < stages.n; k++)
		if (stages.of[k]->tool == tool && same_words(k, words)) {
			*s = stages.of[k];
			return 0;
		}
	return tool ? stage_add(tool, words, s) : pm_fail(PM_DATA, "rank %d has no word '%s'", pm_world_rank(), name);
}

static int wrong(const char *what, const json_error_t *error)
{
	const bool memory = !strcmp(pm_message(), "out of memory"); /* said by the allocator of jansson, whose reader may call it a wrong token */
	return memory ? pm_no_memory() : pm_fail(PM_DATA, "%s is wrong: %s", what, error->text);
}

/* The header, before and behind declare(). */
static int frame_of(struct pm_stage *s, const json_t *all, struct pm_frame **f)
{
	json_error_t error;
	json_t *both = json_loads(json_string_value(json_object_get(all, "frame")), 0, &error);
	int status = both ? pm_header_frame(json_object_get(both, "header"), f) : wrong("the header of a divided frame", &error);
	status = status ? status : pm_limits_take_all(json_object_get(both, "limits"), *f);
	json_decref(both);
	if (status)
		return status;
	const int plan = pm_stage_declare(s, *f);
	return plan > 0 && plan != PM_HOLD ? pm_fail(PM_DATA, "rank %d sees another frame than rank 0", pm_world_rank()) : plan < 0 ? plan : 0;
}

static void hand_over(struct pm_note **from, struct pm_note **to)
{
	*to = *from;
	*from = NULL;
}

static int take_parts(const json_t *fields, struct uses *u)
{
	if (json_array_size(fields) != u->n)
		return pm_fail(PM_DATA, "rank %d uses other fields than rank 0", pm_world_rank());
	const size_t ranks = (size_t)pm_world_size();
	for (size_t i = 0; i < u->n; i++) {
		const json_t *said = json_array_get(fields, i);
		struct used *one = &u->of[i];
		struct pm_field *p = one->field;
		one->was = (uint64_t)json_integer_value(json_object_get(said, "was"));
		one->is = (uint64_t)json_integer_value(json_object_get(said, "is"));
		p->finite = json_is_true(json_object_get(said, "finite"));
		if (!(one->from = calloc(ranks + 1, sizeof *one->from)))
			return pm_no_memory();
		for (size_t r = 0; r <= ranks; r++)
			one->from[r] = (uint64_t)json_integer_value(json_array_get(json_object_get(said, "from"), r));
		/* A field that is changed in place is this frame's alone; another is copied when it changes. */
		p->buffer = one->was ? pm_parts_of(one->was, one->was == one->is && p->use & PM_USE_CHANGE) : NULL;
		if (one->was && !p->buffer)
			return pm_fail(PM_DATA, "rank %d has no part of '%s'", pm_world_rank(), p->name);
		if (p->buffer)
			hand_over(&p->buffer->note, &p->note);
	}
	return 0;
}

/* The parts stay when the frame is gone. */
static void keep(const struct uses *u)
{
	for (size_t i = 0; i < u->n; i++) {
		struct pm_field *p = u->of[i].field;
		struct pm_buffer *b = p ? pm_parts_of(u->of[i].is, false) : NULL; /* there already: it was read alone */
		if (u->of[i].is && p && p->buffer && !b && pm_parts_keep(u->of[i].is, p->buffer))
			pm_cannot_go_on();
		if (u->of[i].is && p && p->buffer && !p->buffer->note)
			hand_over(&p->note, &p->buffer->note);
		pm_buffer_free(b);
	}
}

int pm_divided_follow(const struct pm_tool *tool, const char *text)
{
	json_error_t error;
	json_t *all = json_loads(text, 0, &error);
	struct pm_stage *s = NULL;
	struct pm_frame *f = NULL;
	struct uses u = {0, NULL};
	int status = all ? stage_of(tool, all, &s) : wrong("a request of rank 0", &error);
	status = status ? status : frame_of(s, all, &f);
	status = status ? status : uses_make(&u, f);
	status = status ? status : take_parts(json_object_get(all, "fields"), &u);
	status = run_here(s, f, &u, status);
	leave(&u);
	keep(&u);
	uses_free(&u);
	pm_frame_free(f);
	json_decref(all);
	return status;
}

/* ---- sources ---- */

/* Every rank, with its status. s NULL: it could not be made. */
static int source_here(struct pm_stage *s, int status, struct uses *u, struct pm_frame **f)
{
	const struct pm_world_traffic before = pm_world_traffic();
	*f = NULL;
	status = pm_world_agree(status);
	if (status)
		return status;
	const int got = s->tool->source(s, f);
	status = pm_world_agree(got < 0 ? got : 0);
	if (!status && got > 0) {
		status = adopt(status, u, *f);
		status = pm_world_agree(status ? status : pm_frame_settle(*f));
		leave(u);
	}
	sent_since(s, before);
	return status ? status : got;
}

int pm_divided_source(struct pm_stage *s, struct pm_frame **f)
{
	struct uses u = {0, NULL};
	json_t *all = json_pack("{s:s,s:o}", "word", s->tool->name, "words", words_of(s));
	char *text = all ? pm_json_line(all) : NULL;
	int status = text ? pm_request_send(PM_REQUEST_SOURCE, text, strlen(text)) : pm_no_memory();
	json_decref(all), free(text);
	status = status ? status : source_here(s, 0, &u, f);
	uses_free(&u);
	if (status < 0)
		*f = pm_frame_free(*f);
	return status;
}

void pm_divided_source_follow(const struct pm_tool *tool, const char *text)
{
	struct uses u = {0, NULL};
	struct pm_stage *s = NULL;
	struct pm_frame *f = NULL;
	json_error_t error;
	json_t *all = json_loads(text, 0, &error);
	const int status = all ? stage_of(tool, all, &s) : wrong("a request of rank 0", &error);
	source_here(s, status, &u, &f);
	keep(&u);
	uses_free(&u);
	pm_frame_free(f);
	json_decref(all);
}

/* ---- what they did ---- */

/* Every rank: its work [ns], and what it sent. */
static int tally(int status, double seconds, const uint64_t sent[2], struct pm_tally *t)
{
	int64_t sum[] = {(int64_t)sent[0], (int64_t)sent[1], (int64_t)(1e9 * seconds)}, most = sum[2];
	status = pm_world_count(status, PM_SUM_OF, 3, sum);
	status = pm_world_count(status, PM_MOST_OF, 1, &most);
	*t = (struct pm_tally){(uint64_t)sum[0], (uint64_t)sum[1], sum[2] > 0 ? (double)most * pm_world_size() / (double)sum[2] : 1};
	return status;
}

int pm_divided_tally(const struct pm_stage *s, double seconds, const uint64_t sent[2], struct pm_tally *t)
{
	json_t *words = s ? words_of(s) : json_array();
	json_t *all = s ? json_pack("{s:s,s:o}", "word", s->tool->name, "words", words) : words;
	char *text = all ? pm_json_line(all) : NULL;
	int status = text ? pm_request_send(PM_REQUEST_TALLY, text, strlen(text)) : pm_no_memory();
	json_decref(all), free(text);
	return status ? status : tally(0, seconds, sent, t);
}

void pm_divided_tally_follow(const struct pm_tool *tool, const char *text)
{
	const struct pm_world_traffic now = pm_world_traffic();
	const uint64_t none[2] = {now.bytes, now.messages};
	struct pm_stage *s = NULL;
	struct pm_tally t;
	json_error_t error;
	json_t *all = json_loads(text, 0, &error);
	int status = !all ? wrong("a request of rank 0", &error) : json_is_object(all) ? stage_of(tool, all, &s) : 0;
	tally(status, s ? s->shared : 0, s ? s->sent : none, &t);
	json_decref(all);
}

void pm_divided_free(void)
{
	for (size_t i = 0; i < stages.n; i++) {
		pm_stage_free(stages.of[i]);
		words_free(stages.argv[i], stages.argc[i]);
	}
	free(stages.of), free(stages.argv), free(stages.argc);
	stages.of = NULL, stages.argv = NULL, stages.argc = NULL;
	stages.n = stages.room = 0;
}
