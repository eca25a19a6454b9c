/* Compares sums over the sets that are still there, so that a set may be dropped. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "cycle/watch.h"

void pm_watch_begin(struct pm_watch *w, const struct pm_frame *f)
{
	pm_strengths_of(f, NULL, &w->first);
	for (int i = 0; i < w->first.n; i++)
		w->permitted[i] = pm_strength_permitted(f, w->first.of[i].name);
}

/* Is entry i the first of its name? */
static bool leads(const struct pm_strengths *s, int i)
{
	for (int k = 0; k < i; k++)
		if (!strcmp(s->of[k].name, s->of[i].name))
			return false;
	return true;
}

/* m2p knows one way in which strength is lost. */
static const char *reason(const struct pm_frame *f, const char *name, char text[200])
{
	char key[PM_STRENGTH_NAME + 2];
	snprintf(key, sizeof key, "d%s", name);
	const double gap = pm_strength_reported(f, "lost", key);
	snprintf(text, 200, "m2p reports that %.3g per time diffuses to where no particle is: a shorter dt, which keeps the particles together, or "
		"remesh --rim 2", gap);
	return gap != 0 ? text : "sls --report shows what the words did; --moves WORD allows a foreign word to change it";
}

/* The sums of one name, over the sets that are there still, and what is allowed. */
static int compare(const struct pm_watch *w, const struct pm_frame *f, const struct pm_strengths *now, int i)
{
	const char *name = w->first.of[i].name;
	const double allowed = pm_strength_permitted(f, name) - w->permitted[i];
	struct pm_strength a = {.sum = 0}, b = {.sum = 0};
	char text[200];
	for (int k = i; k < w->first.n; k++) {
		const struct pm_strength *here = strcmp(w->first.of[k].name, name) ? NULL : pm_strength_find(now, w->first.of[k].on, name);
		a.sum += here ? w->first.of[k].sum : 0;
		a.scale += here ? w->first.of[k].scale : 0;
		b.sum += here ? here->sum : 0;
		b.size += here ? here->size : 0;
	}
	const double change = b.sum - a.sum - allowed, round_off = 1e-9 * (b.size + fabs(allowed)); /* of sums that have grown */
	if (fabs(change) <= pm_strength_tolerance * a.scale + round_off)
		return 0;
	return pm_fail(PM_NUMERICS, "the sum of '%s' went from %.6g to %.6g; for %.3g of that no absorbing face, cut-off, --outside drop or given rate "
		"accounts (%s)", name, a.sum, b.sum, change, reason(f, name, text));
}

int pm_watch_step(const struct pm_watch *w, const struct pm_frame *f)
{
	struct pm_strengths now;
	int status = 0;
	pm_strengths_of(f, NULL, &now);
	for (int i = 0; i < w->first.n && !status; i++)
		status = leads(&w->first, i) ? compare(w, f, &now, i) : 0;
	return status;
}

json_t *pm_watch_save(const struct pm_watch *w)
{
	json_t *list = json_array();
	for (int i = 0; i < w->first.n; i++) {
		const struct pm_strength *s = &w->first.of[i];
		json_array_append_new(list, json_pack("{s:s,s:s,s:f,s:f,s:f}", "on", s->on, "name", s->name, "sum", s->sum, "scale", s->scale, "permitted",
			w->permitted[i]));
	}
	return list;
}

void pm_watch_load(struct pm_watch *w, const struct pm_frame *f, const json_t *saved)
{
	size_t i;
	json_t *entry;
	if (!json_is_array(saved)) {
		pm_watch_begin(w, f);
		return;
	}
	w->first.n = 0;
	json_array_foreach(saved, i, entry)
	{
		const char *on = json_string_value(json_object_get(entry, "on")), *name = json_string_value(json_object_get(entry, "name"));
		if (!on || !name || w->first.n == PM_STRENGTHS)
			continue;
		struct pm_strength *s = &w->first.of[w->first.n];
		snprintf(s->on, sizeof s->on, "%s", on);
		snprintf(s->name, sizeof s->name, "%s", name);
		s->sum = json_number_value(json_object_get(entry, "sum"));
		s->scale = json_number_value(json_object_get(entry, "scale"));
		w->permitted[w->first.n++] = json_number_value(json_object_get(entry, "permitted"));
	}
}
