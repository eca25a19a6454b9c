/* The effects say themselves what asks for them, beside which words, and which words do them (effect/effect.h). SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "cycle/missing-words.h"
#include "planner/plan.h"

/* A word, an action of push, or a word with the options typed: "--green plummer" of any, "pp --softening" of pp. */
static bool says(const struct pm_sentence *s, const char *what)
{
	bool found = pm_sentence_says(s, what);
	for (int i = 0; i < pm_sentence_words(s) && !found; i++) {
		const struct pm_stage *stage = pm_sentence_stage(s, i);
		const char *options = strchr(what, '-') == what ? what : strstr(what, " -");
		const size_t n = options && options > what ? (size_t)(options - what) : 0;
		found = options && stage && (!n || !strncmp(stage->tool->name, what, n)) && strstr(stage->word, options);
	}
	return found;
}

static bool done(const struct pm_sentence *s, const struct pm_effect *e, char list[120])
{
	bool said = false;
	list[0] = 0;
	for (int i = 0; e->done_by[i] && !said; i++) {
		const size_t at = strlen(list);
		snprintf(list + at, 120 - at, "%s%s", i ? ", " : "", e->done_by[i]);
		said = says(s, e->done_by[i]);
	}
	return said;
}

static bool beside(const struct pm_sentence *s, const struct pm_effect *e)
{
	bool found = !e->asked_beside;
	for (int i = 0; e->asked_beside && e->asked_beside[i] && !found; i++)
		found = pm_sentence_says(s, e->asked_beside[i]);
	return found;
}

/* The words that make a force by a mesh, as typed; "" if there are none. */
static void force_of(const struct pm_sentence *s, char text[PM_PLAN_TEXT])
{
	size_t n = 0;
	bool mesh = false;
	text[0] = 0;
	for (int i = 0; i < pm_sentence_words(s) && n < PM_PLAN_TEXT; i++) {
		const struct pm_stage *stage = pm_sentence_stage(s, i);
		mesh = mesh || (stage && !strcmp(stage->tool->name, "p2m"));
		if (stage && stage->tool->makes)
			n += (size_t)snprintf(text + n, PM_PLAN_TEXT - n, "%s%s", n ? " | " : "", stage->word);
	}
	if (!mesh || n >= PM_PLAN_TEXT)
		text[0] = 0;
}

void pm_missing_words(const struct pm_sentence *s, const struct pm_frame *f, double end)
{
	char force[PM_PLAN_TEXT];
	const struct pm_law *law = pm_law_of(f);
	force_of(s, force);
	for (int i = 0; law && pm_effects[i]; i++) {
		const struct pm_effect *e = pm_effects[i];
		const struct pm_plan_choice choice = {.accuracy = 0.01, .time = end, .force = e->asked_beside ? force : NULL}; /* the default of plan */
		struct pm_decision d;
		char what[64], words[120];
		if (!e->asked || !e->asked(f, law, what) || !beside(s, e) || done(s, e, words))
			continue;
		if (!pm_plan_decide(f, e, &choice, &d) && d.answer == PM_PUT_IN && !d.kept) /* a frame that cannot be planned is not judged */
			fprintf(stderr, "cycle: the frame has %s, but no word of the sentence acts by it (%s): %s\n", what, words, d.text);
	}
}
