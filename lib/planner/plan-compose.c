/* The sentence of a plan: the words of the effects, sorted by their slots, between the pushes. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "effect-parts/effect-words.h"
#include "planner/plan.h"

static bool is_in(const struct pm_plan_effect *e) { return e->decision.answer == PM_PUT_IN && !e->lacking; }

void pm_plan_case(const struct pm_frame *f, const struct pm_plan *p, int i, struct pm_effect_case *c)
{
	*c = (struct pm_effect_case){.frame = f, .law = p->law, .scales = &p->scales, .method = &p->method, .own = p->effect[i].own,
		.decision = &p->effect[i].decision};
	for (int k = 0; k < p->neffects; k++) {
		c->decided[k] = p->effect[k].decision;
		c->decided[k].answer = is_in(&p->effect[k]) ? PM_PUT_IN : PM_LEFT_OUT;
	}
}

bool pm_plan_forced(const struct pm_plan *p)
{
	bool forced = false;
	for (int i = 0; i < p->neffects; i++)
		forced = forced || (p->effect[i].effect->force && is_in(&p->effect[i]));
	return forced;
}

/* The requirements of the effects on the method, then their words. */
static void ask(const struct pm_frame *f, struct pm_plan *p, struct pm_words *w)
{
	struct pm_effect_case c;
	p->method.kick = "kick/2";
	for (int i = 0; i < p->neffects; i++)
		if (p->effect[i].effect->ask) {
			pm_plan_case(f, p, i, &c);
			p->effect[i].effect->ask(&c, &p->method);
		}
	for (int i = 0; i < p->neffects; i++)
		if (p->effect[i].effect->words) {
			pm_plan_case(f, p, i, &c);
			p->effect[i].effect->words(&c, w);
		}
}

/* The time step is given once, in the first push. */
static void push(const struct pm_plan *p, struct pm_words *w, enum pm_slot slot, bool first, const char *actions, const char *reason)
{
	char words[160];
	if (first && !isnan(p->method.tolerance))
		snprintf(words, sizeof words, "push %s --tolerance %.3g", actions, p->method.tolerance);
	else if (first && !isnan(p->method.dt))
		snprintf(words, sizeof words, "push --dt %.12g %s", p->method.dt, actions);
	else
		snprintf(words, sizeof words, "push %s", actions);
	pm_words_add(w, slot, words, "%s", reason);
}

/* Steps that follow the fastest orbit: before the push that begins one, and after the force; those of ias15 are only made to end at the end. */
static void follow(const struct pm_plan *p, struct pm_words *w, enum pm_slot slot)
{
	char words[160];
	snprintf(words, sizeof words, "dt --oscillation %.6g --until %.17g", p->method.follow, p->method.until);
	if (!isnan(p->method.follow))
		pm_words_add(w, slot, words, "%s", "as short as the fastest orbit needs, the last ones to the end");
	snprintf(words, sizeof words, "dt --until %.17g", p->method.until);
	if (!isnan(p->method.tolerance))
		pm_words_add(w, slot, words, "%s", "the scheme chooses its steps, the last ones to the end");
}

static void pushes(struct pm_plan *p, struct pm_words *w, bool forced)
{
	const bool leaps = forced && p->scales.second && !strcmp(p->method.scheme, "leapfrog");
	char actions[32];
	const char *with = p->scales.light ? "" : " drift"; /* which is a word of its own behind the current */
	const bool chosen = !isnan(p->method.tolerance); /* its step is known after it */
	if (forced && !chosen)
		follow(p, w, leaps ? PM_SLOT_OPENING : PM_SLOT_CLOSING);
	if (!forced) {
		p->method.dt = NAN; /* any step is possible */
		push(p, w, PM_SLOT_OPENING, true, "drift", "no force: straight lines");
	} else if (leaps) {
		snprintf(actions, sizeof actions, "%s%s", p->method.kick, with);
		push(p, w, PM_SLOT_OPENING, true, actions, p->method.why_step);
		push(p, w, PM_SLOT_CLOSING, false, p->method.kick, "the second half of the kick");
	} else
		push(p, w, PM_SLOT_CLOSING, true, p->method.scheme, p->method.why_step);
	if (forced && chosen)
		follow(p, w, PM_SLOT_CLOSING);
}

/* Without a force only the opening slot and the slot after the step remain. */
static void sort(struct pm_plan *p, const struct pm_words *w, bool forced)
{
	p->nstages = 0;
	for (int slot = 0; slot < PM_SLOTS; slot++)
		for (int i = 0; i < w->n && p->nstages < PM_PLAN_WORDS; i++)
			if ((int)w->word[i].slot == slot && (forced || slot == PM_SLOT_OPENING || slot == PM_SLOT_AFTER)) {
				struct pm_plan_word *s = &p->stage[p->nstages++];
				memcpy(s->words, w->word[i].words, sizeof s->words);
				memcpy(s->reason, w->word[i].reason, sizeof s->reason);
				s->seconds = NAN;
			}
}

static void join(struct pm_plan *p)
{
	size_t at = 0;
	p->sentence[0] = 0;
	for (int i = 0; i < p->nstages && at < sizeof p->sentence; i++)
		at += (size_t)snprintf(p->sentence + at, sizeof p->sentence - at, "%s%s", i ? " | " : "", p->stage[i].words);
}

int pm_plan_compose(const struct pm_frame *f, struct pm_plan *p)
{
	const bool forced = pm_plan_forced(p);
	struct pm_words w = {.n = 0};
	ask(f, p, &w);
	if (!forced && !p->scales.second)
		return pm_fail(PM_DATA, "nothing moves in this frame: the law '%s' gives its particles no velocity, and they have none", p->law->name);
	pushes(p, &w, forced);
	pm_words_settle(&w);
	sort(p, &w, forced);
	join(p);
	return 0;
}
