/* What a frame asks for and the sentence does not do. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CYCLE_MISSING_WORDS_H
#define PM_CYCLE_MISSING_WORDS_H

#include "sentence/sentence.h"

/* A line on standard error for every effect that the frame's constants or fields ask for, that no word does, and that plan would put in at its default
 * accuracy for a run until time end (NAN: a hundred steps). Costs a force where an effect is asked for and missing, else nothing. */
void pm_missing_words(const struct pm_sentence *s, const struct pm_frame *f, double end);

#endif
