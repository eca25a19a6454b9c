/* sel: selects frames, sets, meshes, fields, and particles by an expression. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expression/expression.h"
#include "stage/stage.h"
#include "stream/join.h"

struct config {
	struct pm_list frames, sets, meshes, fields, drop;
	const char *where;
	int64_t every;
	bool last;
};

struct state {
	uint64_t frame;         /* from 1 */
	struct pm_frame *kept;  /* the last one so far, with --last */
};

static const struct pm_option options[] = {
	{.name = "frames", .kind = PM_LIST, .unit = "N|N:M", PM_AT(frames),
		.text = "frames by number, counted from 1: 1,3,5:10 or 7: for all from the seventh"},
	{.name = "every", .kind = PM_INTEGER, .unit = "steps", .fallback = "1", .low = 1, .high = 1e15, PM_AT(every),
		.text = "frames whose step is a multiple of this"},
	{.name = "last", .kind = PM_FLAG, PM_AT(last), .text = "the last frame of each stream only, of those that are left"},
	{.name = "set", .kind = PM_LIST, .unit = "NAME", PM_AT(sets), .text = "keep these sets, no others"},
	{.name = "mesh", .kind = PM_LIST, .unit = "NAME", PM_AT(meshes), .text = "keep these meshes, no others"},
	{.name = "field", .letter = 'f', .kind = PM_LIST, .unit = "NAME|ON/NAME", PM_AT(fields), .text = "keep these fields, no others"},
	{.name = "drop", .kind = PM_LIST, .unit = "NAME|ON/NAME", PM_AT(drop), .text = "leave these fields, sets or meshes out"},
	{.name = "where", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(where), .text = "keep the particles for which this is true: 'x < 0.5 && mass > 0'"},
	{0},
};

/* "3" or "3:5" or "3:" as first and last. */
static bool range(const char *text, uint64_t *first, uint64_t *last)
{
	char *end;
	if (*text < '0' || *text > '9')
		return false;
	*first = *last = strtoull(text, &end, 10);
	if (*end == ':') {
		const char *second = end + 1;
		*last = *second ? strtoull(second, &end, 10) : UINT64_MAX;
		end = *second ? (*second < '0' || *second > '9' ? "bad" : end) : "";
	}
	return !*end && *first >= 1 && *last >= *first;
}

static int begin(struct pm_stage *s)
{
	const struct config *c = s->config;
	uint64_t first, last;
	for (int i = 0; i < c->frames.n; i++)
		if (!range(c->frames.item[i], &first, &last))
			return pm_fail(PM_USAGE, "--frames '%s' is neither N nor N:M with N from 1 and not above M", c->frames.item[i]);
	s->leaves_out = c->frames.n || c->every > 1 || c->last;
	return 0;
}

static bool frame_chosen(const struct config *c, const struct pm_frame *f, uint64_t number)
{
	bool in = !c->frames.n;
	for (int i = 0; i < c->frames.n && !in; i++) {
		uint64_t first, last;
		in = range(c->frames.item[i], &first, &last) && number >= first && number <= last;
	}
	return in && f->step % c->every == 0;
}

static bool listed(const struct pm_list *list, const struct pm_field *p)
{
	char full[2 * PM_NAME];
	snprintf(full, sizeof full, "%s/%s", p->on, p->name);
	for (int i = 0; i < list->n; i++)
		if (!strcmp(list->item[i], p->name) || !strcmp(list->item[i], full))
			return true;
	return false;
}

static bool named(const struct pm_list *list, const char *name)
{
	for (int i = 0; i < list->n; i++)
		if (!strcmp(list->item[i], name))
			return true;
	return false;
}

/* Every word of a list stands for something that is there. */
static int all_there(const struct pm_frame *f, const struct pm_list *list, const char *option, bool sets, bool meshes, bool fields)
{
	for (int i = 0; i < list->n; i++) {
		const struct pm_list one = {.item = {list->item[i]}, .n = 1};
		bool there = (sets && pm_frame_set(f, list->item[i])) || (meshes && pm_frame_mesh(f, list->item[i]));
		for (size_t k = 0; fields && k < f->nfields; k++)
			there |= listed(&one, f->fields[k]);
		if (!there)
			return pm_fail(PM_DATA, "--%s: there is no '%s' (sls lists what there is)", option, list->item[i]);
	}
	return 0;
}

/* Sets, meshes and fields that were not chosen go. */
static void leave_out(const struct config *c, struct pm_frame *f)
{
	for (size_t i = f->nsets; i-- > 0;)
		if ((c->sets.n && !named(&c->sets, f->sets[i]->name)) || named(&c->drop, f->sets[i]->name))
			pm_frame_remove(f, f->sets[i]->name);
	for (size_t i = f->nmeshes; i-- > 0;)
		if ((c->meshes.n && !named(&c->meshes, f->meshes[i]->name)) || named(&c->drop, f->meshes[i]->name))
			pm_frame_remove(f, f->meshes[i]->name);
	for (size_t i = f->nfields; i-- > 0;)
		if ((c->fields.n && !listed(&c->fields, f->fields[i])) || listed(&c->drop, f->fields[i]))
			pm_drops(f, f->fields[i]);
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct state *st = s->state;
	struct pm_expression e;
	int status;
	st->frame += !s->trial;
	if (!frame_chosen(c, f, st->frame + s->trial))
		return PM_SKIP;
	if ((status = all_there(f, &c->sets, "set", true, false, false)) || (status = all_there(f, &c->meshes, "mesh", false, true, false)) ||
		(status = all_there(f, &c->fields, "field", false, false, true)) || (status = all_there(f, &c->drop, "drop", true, true, true)))
		return status;
	if (c->where && !f->nsets)
		return pm_fail(PM_DATA, "no particles for --where to choose from");
	for (size_t i = 0; c->where && i < f->nsets; i++) {
		const char *on = f->sets[i]->name;
		if ((c->sets.n && !named(&c->sets, on)) || named(&c->drop, on))
			continue;
		if ((status = pm_expression_compile(&e, f, on, c->where)))
			return status;
		for (size_t k = 0, n = f->nfields; k < n;) { /* pm_changes moves a field to the end of the list */
			struct pm_field *p = f->fields[k];
			if (strcmp(p->on, on) || p->uniform || p->use & PM_USE_CHANGE) {
				k++;
				continue;
			}
			p->use |= p->use & PM_USE_READ ? 0 : PM_USE_ANY; /* what the expression does not ask for may be anything */
			pm_changes(f, on, p->name), n--;
		}
	}
	if (!c->where)
		leave_out(c, f);
	return c->where || c->last ? PM_HOLD : 0;
}

static int select_particles(const struct config *c, struct pm_frame *f, struct pm_set *set)
{
	struct pm_expression e;
	size_t n = set->n;
	double *y = pm_alloc(n ? n : 1, sizeof *y);
	unsigned char *keep = (unsigned char *)y;
	int status = y ? pm_expression_compile(&e, f, set->name, c->where) : -PM_DATA;
	if (!status) {
		pm_expression_eval(&e, f, 0, n, y);
		for (size_t i = 0; i < n && !status; i++) {
			double v = y[i]; /* the byte overwrites numbers that have been looked at */
			keep[i] = v != 0;
			if (isnan(v))
				status = pm_fail(PM_NUMERICS, "--where is not a number for the particle at index %zu of '%s'", i, set->name);
		}
	}
	if (!status)
		status = pm_frame_select(f, set, keep);
	pm_free(y);
	return status;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct state *st = s->state;
	int status = 0;
	if (c->where) {
		for (size_t i = 0; i < f->nsets && !status; i++)
			if ((!c->sets.n || named(&c->sets, f->sets[i]->name)) && !named(&c->drop, f->sets[i]->name))
				status = select_particles(c, f, f->sets[i]);
		leave_out(c, f);
	}
	if (status || !c->last)
		return status;
	pm_frame_free(st->kept);
	st->kept = pm_frame_copy(f);
	return st->kept ? PM_SKIP : -PM_DATA;
}

static int flush(struct pm_stage *s, struct pm_writer *w)
{
	struct state *st = s->state;
	int status = st->kept ? pm_write_frame(w, st->kept) : 0;
	st->kept = pm_frame_free(st->kept);
	return status;
}

static void done(struct pm_stage *s) { pm_frame_free(((struct state *)s->state)->kept); }

static const struct pm_example examples[] = {
	{"The particles within a distance, without their velocities.", "pinit plummer -n 1000 | sel --where 'x^2+y^2+z^2 < 1' --drop v | sls"},
	{"The first and the third frame.", "pinit plummer -n 10 > a; cat a a a | sel --frames 1,3 | sls"},
	{"The last frame, positions only.", "pinit plummer -n 10 | cycle -n 3 --every 1 'push kick/2 drift | pp | push kick/2' | sel --last --field x,id | sls"},
	{0}};

const struct pm_tool tool_sel = {
	.name = "sel",
	.summary = "selects frames, sets, fields and particles",
	.about = "What is not named stays. Frames are counted from 1 over the whole input, as in messages. --where keeps the particles for which an expression is not 0 (see "
		 "scalc); their derived fields and changes stay what they were when all particles were there. What --set, --field or --drop names must be in every frame.",
	.kind = PM_FILTER,
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.flush = flush,
	.free = done,
};
