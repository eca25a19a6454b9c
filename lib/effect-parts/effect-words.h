/* The words that effects contribute to a sentence, and what several of them ask to find theirs. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EFFECT_WORDS_H
#define PM_EFFECT_WORDS_H

#include "effect/effect.h"

struct pm_mesh;

/* A word with its options, and its reason. */
__attribute__((format(printf, 4, 5))) void pm_words_add(struct pm_words *w, enum pm_slot slot, const char *words, const char *reason, ...);
/* Options and a further reason for the first such word of a slot, which another effect or plan adds, earlier or later; without it no effect. */
__attribute__((format(printf, 5, 6))) void pm_words_amend(struct pm_words *w, enum pm_slot slot, const char *word, const char *options,
	const char *reason, ...);
/* Applies the amendments to their words. */
void pm_words_settle(struct pm_words *w);

/* Is the effect of this name included? */
bool pm_effect_in(const struct pm_effect_case *c, const char *name);
/* The mesh with the given fields (E, B, u); NULL none. */
const struct pm_mesh *pm_effect_given_mesh(const struct pm_frame *f, const struct pm_law *law);
/* The option for the mesh of the self field: a separate mesh if a given field occupies the other; "": the frame's. */
const char *pm_effect_own_mesh(const struct pm_frame *f, const struct pm_law *law);

#endif
