/* A whole step of a sentence. SPDX-License-Identifier: GPL-3.0-or-later */
#include "sentence/sentence.h"

enum { most_passes = 512 }; /* ias15 iterates, and rejects steps */

int pm_sentence_ready(struct pm_sentence *s, struct pm_frame **f)
{
	const int needs = (*f)->substep == 0 ? pm_sentence_needs_priming(s, *f) : 0;
	return needs > 0 ? pm_sentence_prime(s, f) : needs;
}

int pm_sentence_step(struct pm_sentence *s, struct pm_frame **f)
{
	const int64_t before = (*f)->step;
	int status = pm_sentence_ready(s, f);
	for (int pass = 0; pass < most_passes && !status && (*f)->step == before; pass++)
		status = pm_sentence_pass(s, f);
	return status || (*f)->step > before ? status : pm_fail(PM_USAGE, "the sentence has no word that completes a step (add push)");
}
