/* Words of effects, collected; lib/planner/plan-compose.c puts them in order. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "effect-parts/effect-words.h"
#include "law/law.h"

void pm_words_add(struct pm_words *w, enum pm_slot slot, const char *words, const char *reason, ...)
{
	struct pm_word *s = &w->word[w->n];
	va_list list;
	if (w->n == PM_EFFECT_WORDS)
		return;
	s->slot = slot;
	snprintf(s->words, sizeof s->words, "%s", words);
	va_start(list, reason);
	vsnprintf(s->reason, sizeof s->reason, reason, list);
	va_end(list);
	w->n++;
}

void pm_words_amend(struct pm_words *w, enum pm_slot slot, const char *word, const char *options, const char *reason, ...)
{
	struct pm_amendment *a = &w->amendment[w->amendments];
	va_list list;
	if (w->amendments == PM_EFFECT_WORDS)
		return;
	a->word = word;
	a->more.slot = slot;
	snprintf(a->more.words, sizeof a->more.words, "%s", options);
	va_start(list, reason);
	vsnprintf(a->more.reason, sizeof a->more.reason, reason, list);
	va_end(list);
	w->amendments++;
}

static void append(char *text, size_t size, const char *more)
{
	const size_t at = strlen(text);
	snprintf(text + at, size - at, "%s", more);
}

static bool is(const struct pm_word *w, enum pm_slot slot, const char *word)
{
	const size_t n = strlen(word);
	return w->slot == slot && !strncmp(w->words, word, n) && (!w->words[n] || w->words[n] == ' ');
}

void pm_words_settle(struct pm_words *w)
{
	for (int i = 0; i < w->amendments; i++) {
		const struct pm_amendment *a = &w->amendment[i];
		int k = 0;
		while (k < w->n && !is(&w->word[k], a->more.slot, a->word))
			k++;
		if (k < w->n) {
			append(w->word[k].words, sizeof w->word[k].words, a->more.words);
			append(w->word[k].reason, sizeof w->word[k].reason, a->more.reason);
		}
	}
	w->amendments = 0;
}

bool pm_effect_in(const struct pm_effect_case *c, const char *name)
{
	for (int i = 0; pm_effects[i] && i < PM_EFFECTS; i++)
		if (!strcmp(pm_effects[i]->name, name))
			return c->decided[i].answer == PM_PUT_IN;
	return false;
}

static bool holds(const struct pm_frame *f, const struct pm_mesh *m, const char *name)
{
	const struct pm_field *field = name ? pm_frame_field(f, m->name, name) : NULL;
	return field && field->role == PM_STATE;
}

const struct pm_mesh *pm_effect_given_mesh(const struct pm_frame *f, const struct pm_law *law)
{
	for (size_t i = 0; i < f->nmeshes; i++)
		if (holds(f, f->meshes[i], law->field) || holds(f, f->meshes[i], law->magnetic))
			return f->meshes[i];
	return NULL;
}

const char *pm_effect_own_mesh(const struct pm_frame *f, const struct pm_law *law)
{
	const struct pm_mesh *given = pm_effect_given_mesh(f, law);
	return given && holds(f, given, law->field) ? " --mesh self" : "";
}
