/* The effects say themselves what asks for them and which words do them (effect/effect.h). SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "cycle/missing-words.h"
#include "planner/plan.h"

static bool done(const struct pm_sentence *s, const struct pm_effect *e, char list[120])
{
	bool said = false;
	list[0] = 0;
	for (int i = 0; e->done_by[i] && !said; i++) {
		const size_t at = strlen(list);
		snprintf(list + at, 120 - at, "%s%s", i ? ", " : "", e->done_by[i]);
		said = pm_sentence_says(s, e->done_by[i]);
	}
	return said;
}

void pm_missing_words(const struct pm_sentence *s, const struct pm_frame *f, double end)
{
	const struct pm_plan_choice choice = {.accuracy = 0.01, .time = end}; /* the default of plan */
	const struct pm_law *law = pm_law_of(f);
	for (int i = 0; law && pm_effects[i]; i++) {
		const struct pm_effect *e = pm_effects[i];
		struct pm_decision d;
		char what[64], words[120];
		if (!e->asked || !e->asked(f, law, what) || done(s, e, words))
			continue;
		if (!pm_plan_decide(f, e, &choice, &d) && d.answer == PM_PUT_IN && !d.kept) /* a frame that cannot be planned is not judged */
			fprintf(stderr, "cycle: the frame has %s, but no word of the sentence acts by it (%s): %s\n", what, words, d.text);
	}
}
