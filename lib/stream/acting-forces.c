/* A field's header and the report hold the same keys. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "stream/acting-forces.h"

static const char *const entry_name = "forces";

void pm_acting_smooth(struct pm_field *change, double softening, const char *mollifier)
{
	json_object_del(change->more, "softening");
	json_object_del(change->more, "mollifier");
	if (!isnan(softening))
		json_object_set_new(change->more, "softening", json_real(softening));
	if (mollifier)
		json_object_set_new(change->more, "mollifier", json_string(mollifier));
}

static bool plain(const struct pm_field *change)
{
	for (int t = 0; t < change->nterms; t++)
		if (strcmp(change->terms[t], "self"))
			return false;
	return !json_object_get(change->more, "softening") && !json_object_get(change->more, "mollifier");
}

void pm_acting_note(struct pm_frame *f, const struct pm_field *change)
{
	char key[2 * PM_NAME + 1];
	json_t *all = json_object_get(f->report, entry_name), *terms;
	if (change->role != PM_CHANGE || (strcmp(change->of, "v") && strcmp(change->of, "x")))
		return; /* it moves nothing */
	snprintf(key, sizeof key, "%s/%s", change->on, change->name);
	if (plain(change)) {
		json_object_del(all, key);
		if (all && !json_object_size(all))
			json_object_del(f->report, entry_name);
		return;
	}
	if (!json_is_object(all)) {
		all = json_object();
		json_object_set_new(f->report, entry_name, all);
	}
	json_t *entry = json_pack("{s:o}", "terms", terms = json_array());
	for (int t = 0; t < change->nterms; t++)
		json_array_append_new(terms, json_string(change->terms[t]));
	if (json_object_get(change->more, "softening"))
		json_object_set(entry, "softening", json_object_get(change->more, "softening"));
	if (json_object_get(change->more, "mollifier"))
		json_object_set(entry, "mollifier", json_object_get(change->more, "mollifier"));
	json_object_set_new(all, key, entry);
}

void pm_acting_forget(struct pm_frame *f) { json_object_del(f->report, entry_name); }

static void smoothing(const json_t *keys, struct pm_acting *a)
{
	const json_t *softening = json_object_get(keys, "softening");
	a->softening = json_is_number(softening) ? json_number_value(softening) : NAN;
	a->mollifier = json_string_value(json_object_get(keys, "mollifier"));
}

struct pm_acting pm_acting_on(const struct pm_frame *f, const char *set, const char *change)
{
	const struct pm_field *field = pm_frame_field(f, set, change);
	struct pm_acting a = {.softening = NAN};
	char key[2 * PM_NAME + 1];
	size_t i;
	json_t *term;
	if (field && field->role == PM_CHANGE) {
		smoothing(field->more, &a);
		for (int t = 0; t < field->nterms && !a.other; t++)
			a.other = strcmp(field->terms[t], "self") ? field->terms[t] : NULL;
		return a;
	}
	snprintf(key, sizeof key, "%s/%s", set, change);
	const json_t *entry = json_object_get(json_object_get(f->report, entry_name), key);
	smoothing(entry, &a);
	json_array_foreach(json_object_get(entry, "terms"), i, term)
		if (!a.other && json_string_value(term) && strcmp(json_string_value(term), "self"))
			a.other = json_string_value(term);
	return a;
}
