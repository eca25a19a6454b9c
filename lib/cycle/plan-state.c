/* What --again has decided, as the header attribute `plan` and in the history. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/decimal.h"
#include "cycle/plan-again.h"
#include "stream/header.h"

static json_t *cells_json(const size_t cells[3])
{
	json_t *list = json_array();
	for (int d = 0; d < 3; d++)
		json_array_append_new(list, json_integer((json_int_t)cells[d]));
	return list;
}

void pm_replan_save(const struct pm_replan *r, struct pm_frame *f)
{
	const struct pm_replan_way *w = &r->way;
	json_t *effects = json_object();
	json_t *plan = json_pack("{s:f,s:I,s:I,s:I,s:I,s:I,s:s}", "accuracy", r->accuracy, "again", (json_int_t)r->every, "first", (json_int_t)r->first,
		"decided", (json_int_t)r->decided, "since", (json_int_t)r->since, "changes", (json_int_t)r->changes, "sentence", r->sentence);
	for (int i = 0; i < PM_EFFECTS && pm_effects[i]; i++)
		if (w->every[i] >= 0)
			json_object_set_new(effects, pm_effects[i]->name, json_integer(w->every[i]));
	json_object_set_new(plan, "began", json_real(r->began));
	json_object_set_new(plan, "end", pm_json_number(r->end));
	json_object_set_new(plan, "given", json_pack("{s:f,s:o}", "dt", r->dt, "cells", cells_json(r->cells)));
	json_object_set_new(plan, "effects", effects);
	json_object_set_new(plan, "way", json_pack("{s:b,s:b,s:s,s:s,s:s,s:s,s:o}", "pairs", w->pairs, "grow", w->grow, "kernel", w->kernel, "symbol",
		w->symbol, "order", w->order, "scheme", w->scheme, "cells", cells_json(w->cells)));
	json_object_set_new(plan, "seen", json_pack("{s:f,s:f,s:f}", "speed", r->seen.speed, "rate", r->seen.rate, "spread", r->seen.spread));
	json_object_set_new(plan, "patience", json_pack("{s:I,s:f}", "decisions", (json_int_t)r->patience.decisions, "dt", r->patience.dt));
	json_object_set_new(f->more, "plan", plan);
}

static bool text(char to[32], const json_t *from, const char *key)
{
	const char *s = json_string_value(json_object_get(from, key));
	snprintf(to, 32, "%s", s ? s : "");
	return s && strlen(s) < 32;
}

static bool cells(size_t to[3], const json_t *from)
{
	for (size_t d = 0; d < 3; d++)
		to[d] = (size_t)json_integer_value(json_array_get(from, d));
	return json_array_size(from) == 3;
}

static int effects(struct pm_replan_way *w, json_t *from)
{
	const char *name;
	json_t *value;
	int known = 0;
	for (int i = 0; i < PM_EFFECTS; i++)
		w->every[i] = -1;
	json_object_foreach(from, name, value)
		for (int i = 0; i < PM_EFFECTS && pm_effects[i]; i++)
			if (!strcmp(pm_effects[i]->name, name))
				w->every[i] = (int)json_integer_value(value), known++;
	return known == (int)json_object_size(from);
}

int pm_replan_load(struct pm_replan *r, const struct pm_frame *f)
{
	const json_t *plan = json_object_get(f->more, "plan"), *given = json_object_get(plan, "given"), *seen = json_object_get(plan, "seen");
	const json_t *way = json_object_get(plan, "way"), *end = json_object_get(plan, "end"), *patience = json_object_get(plan, "patience");
	const char *sentence = json_string_value(json_object_get(plan, "sentence"));
	struct pm_replan_way *w = &r->way;
	r->every = json_integer_value(json_object_get(plan, "again"));
	r->first = json_integer_value(json_object_get(plan, "first"));
	r->decided = json_integer_value(json_object_get(plan, "decided"));
	r->since = json_integer_value(json_object_get(plan, "since"));
	r->changes = json_integer_value(json_object_get(plan, "changes"));
	r->accuracy = json_number_value(json_object_get(plan, "accuracy"));
	r->began = json_number_value(json_object_get(plan, "began"));
	r->end = json_is_number(end) ? json_number_value(end) : NAN;
	r->dt = json_number_value(json_object_get(given, "dt"));
	r->patience.decisions = json_integer_value(json_object_get(patience, "decisions"));
	r->patience.dt = json_number_value(json_object_get(patience, "dt"));
	r->seen.speed = json_number_value(json_object_get(seen, "speed"));
	r->seen.rate = json_number_value(json_object_get(seen, "rate"));
	r->seen.spread = json_number_value(json_object_get(seen, "spread"));
	w->pairs = json_is_true(json_object_get(way, "pairs")), w->grow = json_is_true(json_object_get(way, "grow"));
	bool whole = sentence && strlen(sentence) < sizeof r->sentence && r->every > 0 && r->accuracy > 0 && r->dt != 0;
	whole = text(w->kernel, way, "kernel") && text(w->symbol, way, "symbol") && text(w->order, way, "order") && text(w->scheme, way, "scheme") && whole;
	whole = cells(r->cells, json_object_get(given, "cells")) && cells(w->cells, json_object_get(way, "cells")) && whole;
	whole = effects(w, json_object_get(plan, "effects")) && whole;
	snprintf(r->sentence, sizeof r->sentence, "%s", sentence ? sentence : "");
	return whole ? 0 : pm_fail(PM_DATA, "the attribute 'plan' of the checkpoint is none that this version of cycle --again writes (without --again "
		"the sentence in its history goes on)");
}

void pm_replan_record(const struct pm_replan *r, struct pm_frame *f)
{
	char line[PM_PLAN_TEXT + 32];
	for (size_t i = json_array_size(f->history); i-- > 0;) {
		json_t *entry = json_array_get(f->history, i);
		const char *program = json_string_value(json_object_get(entry, "program"));
		if (!program || strcmp(program, "cycle") || !json_object_get(json_object_get(entry, "options"), "again"))
			continue;
		snprintf(line, sizeof line, "from step %lld: %s", (long long)r->since, r->sentence);
		json_array_append_new(json_object_get(entry, "arguments"), json_string(line));
		return;
	}
}

static void option(json_t *options, const char *name, double x)
{
	char text[PM_DECIMAL_LENGTH];
	pm_decimal_write(text, x, false);
	json_object_set_new(options, name, json_string(text));
}

void pm_replan_entry(const struct pm_replan *r, json_t *entry, const struct pm_loop *c)
{
	json_t *options = json_object_get(entry, "options");
	json_object_set_new(entry, "arguments", json_pack("[s]", r->sentence));
	json_object_set_new(options, "plan", json_true());
	option(options, "again", (double)r->every);
	option(options, "accuracy", r->accuracy);
	if (c->steps != INT64_MIN)
		option(options, "steps", (double)c->steps);
	if (!isnan(c->time))
		option(options, "time", c->time);
	if (c->until)
		json_object_set_new(options, "until", json_string(c->until));
}
