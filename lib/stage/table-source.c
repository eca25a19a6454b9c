/* A text made into frames: a plain table into one, with the attributes that were typed; text that stab wrote into those it was made from.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "law/law.h"
#include "stage/attribute-options.h"
#include "stage/table-source.h"
#include "stream/columns.h"
#include "stream/declare.h"
#include "stream/text.h"
#include "world/world.h"

const char *pm_table_option_given(const struct pm_stage *s)
{
	static const char *const reading[] = {"law", "constant", "dt", "time", "dim", "box", "faces", "particle-faces", "cells", "strength", "unit", "text",
		"skip", "number", NULL};
	int i = 0;
	while (reading[i] && !pm_given(s, reading[i]))
		i++;
	return reading[i];
}

/* The list as names that end in NULL. */
static const char *const *names(struct pm_list *list)
{
	list->item[list->n < PM_LIST_MOST ? list->n : PM_LIST_MOST - 1] = NULL;
	return list->item;
}

/* What was typed, onto a frame that has its particles. */
static int attributes(struct pm_stage *s, struct pm_table_options *c, const char *law, struct pm_frame *g)
{
	size_t cells[3];
	int status;
	g->dt = c->dt;
	pm_columns_box(g, c->set);
	if ((status = pm_attributes_constants(g, &c->constants)) || (status = pm_attributes_law(g, law)) || (status = pm_attributes_box(g, &c->box)) ||
		(status = pm_attributes_faces(g, &c->faces)) || (status = pm_attributes_particle_faces(g, &c->particle_faces)) ||
		(status = pm_attributes_units(g, c->set, &c->units)) || (status = pm_cells_for(&c->cells, g->dim, cells)))
		return status;
	if (!c->box.n)
		pm_report_text(s, g, "box", "automatic");
	return pm_frame_mesh_new(g, "mesh", cells) ? 0 : -PM_DATA;
}

/* A column that is called "m" is no mass. */
static void tell_short_name(struct pm_stage *s, const struct pm_frame *f, const char *set)
{
	const struct pm_law *law = pm_law_of(f);
	if (!law || !law->strength || pm_frame_field(f, set, law->strength))
		return;
	for (size_t i = 0; i < f->nfields; i++) {
		const char *name = f->fields[i]->name;
		if (!strcmp(f->fields[i]->on, set) && !strncasecmp(name, law->strength, strlen(name)))
			pm_tell_once(s, "the law %s takes the column '%s', and there is '%s' (call it %s, if it is meant so)", law->name, law->strength, name,
				law->strength);
	}
}

static int table(struct pm_stage *s, struct pm_text *text, struct pm_table_options *c, struct pm_frame **f)
{
	const struct pm_columns_choice choice = {.set = c->set, .dim = c->dim > 0 ? (int)c->dim : 0, .skip = names(&c->skip), .text = names(&c->text),
		.strength = names(&c->strength), .number = c->number};
	int status = pm_columns_frame(text, &choice, f);
	if (status)
		return status;
	(*f)->time = (*f)->start = c->time;
	status = attributes(s, c, c->law, *f);
	if (!status)
		tell_short_name(s, *f, c->set);
	return status;
}

/* NEMO's units have G = 1 unless somebody says otherwise. */
static int snapshot(struct pm_stage *s, struct pm_nemo *r, struct pm_table_options *c, struct pm_frame **f)
{
	static const char *const columns[] = {"dim", "strength", "text", "skip", "number", NULL};
	const bool law = pm_given(s, "law");
	for (int i = 0; columns[i]; i++)
		if (pm_given(s, columns[i]))
			return pm_fail(PM_USAGE, "--%s is for plain tables, and this is a snapshot of NEMO", columns[i]);
	int got = pm_nemo_next(r, c->set, f);
	if (got < 0)
		return got;
	if (!got)
		pm_tell_once(s, "a snapshot of NEMO%s; left out: %s", law ? "" : ", law gravity with G = 1 (--law, --constant)",
			*r->left_out ? r->left_out : "nothing");
	if (!got)
		return 0;
	if (pm_given(s, "time"))
		(*f)->time = (*f)->start = c->time;
	int status = attributes(s, c, law ? c->law : "gravity", *f);
	return status ? status : 1;
}

static int frames(struct pm_stage *s, struct pm_table_source *st, struct pm_frame **f)
{
	const char *only = pm_table_option_given(s);
	if (only || pm_given(s, "set"))
		return pm_fail(PM_USAGE, "--%s is for plain tables, and this text holds whole frames (change them with smod)", only ? only : "set");
	pm_stage_no_entry(s);
	return pm_text_frame_read(&st->text, f, &st->frames);
}

/* The next frame of the current text, which is open. fresh: it has just been opened. */
static int next_here(struct pm_stage *s, struct pm_table_source *st, struct pm_table_options *options, bool fresh, struct pm_frame **f)
{
	int status = 0;
	if (fresh && !st->text.ranks && pm_nemo_is(st->text.data, st->text.size))
		st->nemo = (struct pm_nemo){.data = st->text.data, .size = st->text.size};
	st->over = fresh && !st->nemo.data && !pm_text_is_frames(&st->text);
	if (st->nemo.data)
		return snapshot(s, &st->nemo, options, f);
	if (fresh && !st->over)
		status = pm_text_frames_index(&st->text);
	if (!st->over)
		return status ? status : frames(s, st, f);
	status = table(s, &st->text, options, f);
	return status ? status : 1;
}

static int next_alone(struct pm_stage *s, struct pm_table_source *st, struct pm_table_options *options, struct pm_frame **f)
{
	const bool fresh = !st->open;
	int status = fresh ? pm_text_open(&st->text, s->args[st->file]) : 0;
	if (status || st->over)
		return status;
	st->open = true;
	return next_here(s, st, options, fresh, f);
}

/* Rank 0 reads, and the others have a frame without fields. */
static int next_of_first(struct pm_stage *s, struct pm_table_source *st, struct pm_table_options *options, struct pm_frame **f)
{
	int got = 0;
	if (pm_world_rank() == 0) {
		const bool apart = pm_world_apart(true);
		got = next_alone(s, st, options, f);
		pm_world_apart(apart);
	}
	const int status = pm_world_share(got < 0 ? got : 0, 0, &got, sizeof got);
	if (!status && got && pm_world_rank() && !(*f = pm_frame_new(1)))
		return pm_failed();
	return status ? status : got;
}

static bool is_nemo(struct pm_text *t)
{
	size_t end;
	const char *first = pm_text_line(t, 0, &end);
	return pm_nemo_is(first, t->size);
}

static int next(struct pm_stage *s, struct pm_table_source *st, struct pm_table_options *options, struct pm_frame **f)
{
	const bool fresh = !st->open && !st->first_only;
	if (pm_world_size() == 1)
		return next_alone(s, st, options, f);
	if (fresh) {
		const int got = pm_text_open_by_ranks(&st->text, s->args[st->file]);
		if (got < 0)
			return got;
		st->open = got, st->first_only = !got;
	}
	if (fresh && st->open && is_nemo(&st->text)) { /* its numbers are where its first bytes say */
		pm_text_close(&st->text);
		st->open = false, st->first_only = true;
	}
	return st->first_only ? next_of_first(s, st, options, f) : st->over ? 0 : next_here(s, st, options, fresh, f);
}

int pm_table_source_next(struct pm_stage *s, struct pm_table_source *st, struct pm_table_options *options, struct pm_frame **f)
{
	char why[512];
	int status = 0;
	*f = NULL;
	for (; st->file < s->nargs && !(status = next(s, st, options, f)); st->file++) {
		pm_table_source_close(st);
		st->over = st->first_only = false;
		st->frames = 0;
	}
	if (status < 0 && st->open) { /* a failure to open names the file itself */
		const char *path = s->args[st->file];
		*f = pm_frame_free(*f);
		snprintf(why, sizeof why, "%s", pm_message());
		return pm_fail(-status, "%s: %s", strcmp(path, "-") ? path : "standard input", why);
	}
	return status;
}

bool pm_table_source_by_ranks(const struct pm_stage *s)
{
	struct stat st;
	for (int i = 0; i < s->nargs; i++)
		if (!strcmp(s->args[i], "-") || stat(s->args[i], &st) || !S_ISREG(st.st_mode))
			return false;
	return s->nargs;
}

void pm_table_source_close(struct pm_table_source *t)
{
	if (t->open)
		pm_text_close(&t->text);
	t->open = false;
	t->nemo.data = NULL;
}
