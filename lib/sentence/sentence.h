/* A sentence: the words between the quotes of cycle, made into stages and run on a frame, fused or as processes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SENTENCE_H
#define PM_SENTENCE_H

#include "stage/stage.h"

struct pm_sentence;

/* moves: foreign words that change state (the others are taken to make change or derived fields). fused: our own words run in this process. */
struct pm_sentence *pm_sentence_new(const char *text, bool fused, const struct pm_list *moves);
void pm_sentence_notes(struct pm_sentence *s, const struct pm_stage *as); /* before the first pass: its words are as verbose or quiet as this one */
int pm_sentence_free(struct pm_sentence *s); /* 0, or failure with the way a process ended */
/* 1 if a word that changes state needs a change field that neither the frame nor an earlier word supplies, else 0; failure where a word in front of it drops
 * that field in every pass. */
int pm_sentence_needs_priming(struct pm_sentence *s, const struct pm_frame *f);
/* Would the next pass use the values of this field of f? Not if a word drops it or makes it anew before any other reads it. A foreign word may read it. */
bool pm_sentence_uses(struct pm_sentence *s, const struct pm_frame *f, const struct pm_field *field);
/* Before a run: writes to the report of f which forces will act, as push does when they have acted (stream/acting-forces.h). Headers alone, no data. */
void pm_sentence_forces(struct pm_sentence *s, struct pm_frame *f);
int pm_sentence_prime(struct pm_sentence *s, struct pm_frame **f); /* the words that make fields from state, once */
int pm_sentence_pass(struct pm_sentence *s, struct pm_frame **f);  /* every word, once */
/* sentence-step.c: before a step, primes a frame that needs it; a whole step, which may take several passes. 0 or failure. */
int pm_sentence_ready(struct pm_sentence *s, struct pm_frame **f);
int pm_sentence_step(struct pm_sentence *s, struct pm_frame **f);
int pm_sentence_end(struct pm_sentence *s); /* the input ended well: calls end() of the words (processes do so themselves) */
int pm_sentence_words(const struct pm_sentence *s); /* how many */
const struct pm_stage *pm_sentence_stage(const struct pm_sentence *s, int word); /* NULL: after the last, or a foreign word */
/* Has it a word or an action of push (boris for boris/2) of this name, or a foreign word, which may do anything? */
bool pm_sentence_says(const struct pm_sentence *s, const char *name);
bool pm_sentence_waits(const struct pm_sentence *s); /* some of its words are processes */
int pm_sentence_safe(const char *text);              /* fails where it runs programs that are not ours, or writes files: for one that nobody typed */
void pm_sentence_ranks(const struct pm_sentence *s, const struct pm_stage *as); /* --verbose: which words the ranks have shared */
int pm_sentence_timing(const struct pm_sentence *s, const char *file); /* 0 or failure */

#endif
