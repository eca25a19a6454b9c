/* The rates of a set's states, found by the names and roles of its fields. Cost: the number of fields squared, no data.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "mesh/force-words.h"
#include "push/state-rates.h"

static int missing(const struct pm_frame *f, const struct pm_set *s, const char *name)
{
	char words[PM_FORCE_WORDS];
	const struct pm_law *law = pm_law_of(f);
	if (law && !*pm_force_words(f, law, NULL, name, words))
		snprintf(words, sizeof words, "field '%.60s = ...'", name);
	return law ? pm_fail(PM_MISSING, "no field '%s' on '%s' (compute it first: %s)", name, s->name, words) : -PM_DATA;
}

int pm_rate_components(const struct pm_rate *r)
{
	return r->rate->components < r->state->components ? r->rate->components : r->state->components;
}

bool pm_rate_is_state(const struct pm_field *field) { return field && field->role == PM_STATE; }

/* Does the set have every term of a change on a mesh? */
static bool carried(const struct pm_frame *f, const struct pm_set *s, const struct pm_field *m)
{
	int found = 0;
	bool any = false;
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *c = f->fields[i];
		if (c->role != PM_CHANGE || strcmp(c->on, s->name) || strcmp(c->of, m->of))
			continue;
		any = true;
		for (int t = 0; t < m->nterms; t++)
			for (int k = 0; k < c->nterms; k++)
				found += !strcmp(m->terms[t], c->terms[k]);
	}
	return any && found >= m->nterms;
}

int pm_rates_allowed(const struct pm_frame *f, const struct pm_set *s, const char *by)
{
	if (by && pm_frame_field(f, s->name, "bfield"))
		return pm_fail(PM_DATA, "'%s' has a magnetic field, which %s would leave out (use a magnetic scheme: push boris/2)", s->name, by);
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *m = f->fields[i];
		if (m->role != PM_CHANGE || !m->of[0] || !pm_frame_mesh(f, m->on) || !pm_rate_is_state(pm_frame_field(f, s->name, m->of)))
			continue;
		if (!carried(f, s, m))
			return pm_fail(PM_DATA, "the change '%s' of '%s' is on mesh '%s' and not yet on '%s' (carry it over with m2p)", m->name, m->of,
				m->on, s->name);
	}
	return 0;
}

/* The rate of one state: *rate NULL if it has none and needs none. */
static int rate_of(const struct pm_frame *f, const struct pm_set *s, const char *state, struct pm_field **rate)
{
	bool x = !strcmp(state, "x"), v = !strcmp(state, "v");
	struct pm_field *velocity = pm_frame_field(f, s->name, "v");
	*rate = NULL;
	if (x && pm_rate_is_state(velocity)) {
		*rate = velocity;
		return 0;
	}
	const char *named = x ? "vel" : v ? "acc" : NULL;
	for (size_t i = 0; i < f->nfields && !*rate; i++) {
		struct pm_field *c = f->fields[i];
		if (c->role == PM_CHANGE && !strcmp(c->on, s->name) && !strcmp(c->of, state) && (!named || !strcmp(c->name, named)))
			*rate = c;
	}
	if (named && !*rate)
		return missing(f, s, named);
	return 0;
}

int pm_rates_complete(const struct pm_frame *f, const struct pm_set *s)
{
	bool v = pm_rate_is_state(pm_frame_field(f, s->name, "v"));
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *c = f->fields[i];
		if (c->role != PM_CHANGE || !c->of[0] || strcmp(c->on, s->name))
			continue;
		if (!pm_rate_is_state(pm_frame_field(f, s->name, c->of)))
			return pm_fail(PM_DATA, "'%s' on '%s' is the change of '%s', which is not there (add it with stab, or push clear)", c->name, s->name,
				c->of);
		if (v && !strcmp(c->of, "x"))
			return pm_fail(PM_DATA, "'%s' has both a velocity 'v' and a change '%s' of 'x' (drop one of them with sel or push clear)", s->name,
				c->name);
	}
	return 0;
}

int pm_rates(const struct pm_frame *f, const struct pm_set *s, enum pm_step_kind kind, struct pm_rate rates[PM_RATES])
{
	static const char *const first[] = {"x", "v"};
	int n = 0, status = 0;
	for (int i = kind == PM_KICK; i < (kind == PM_DRIFT ? 1 : 2) && !status; i++) {
		struct pm_field *state = pm_frame_field(f, s->name, first[i]);
		if (!pm_rate_is_state(state))
			continue;
		rates[n] = (struct pm_rate){.state = state};
		status = rate_of(f, s, first[i], &rates[n++].rate);
	}
	for (size_t i = 0; i < f->nfields && kind != PM_DRIFT && !status; i++) {
		struct pm_field *state = f->fields[i], *rate = NULL;
		if (state->role != PM_STATE || strcmp(state->on, s->name) || !strcmp(state->name, "x") || !strcmp(state->name, "v"))
			continue;
		status = rate_of(f, s, state->name, &rate);
		if (rate && n == PM_RATES)
			return pm_fail(PM_DATA, "more than %d fields of '%s' change", PM_RATES, s->name);
		if (rate)
			rates[n++] = (struct pm_rate){.state = state, .rate = rate};
	}
	return status ? status : n;
}
