/* Words and options of a sentence changed as text: 'p2m -n 32 | ...' becomes 'p2m -n 64 | ...'. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PLANNER_SENTENCE_EDIT_H
#define PM_PLANNER_SENTENCE_EDIT_H

#include "planner/plan.h"

enum { PM_EDIT_WORD = 256 };

struct pm_edit {
	char word[PM_PLAN_WORDS][PM_EDIT_WORD]; /* without comments and blanks around */
	int n;
};

/* An option by its long name and its letter (0 none), as in the rows of its tool. */
struct pm_edit_option {
	const char *name;
	char letter;
};

bool pm_edit_read(struct pm_edit *e, const char *sentence); /* false: too long */
bool pm_edit_write(const struct pm_edit *e, char sentence[PM_PLAN_TEXT]);
int pm_edit_find(const struct pm_edit *e, const char *name, int from); /* the first word of this name at or after from; -1 none */
bool pm_edit_value(const struct pm_edit *e, int word, struct pm_edit_option o, char value[64]); /* false: not given */
bool pm_edit_says(const struct pm_edit *e, int word, const char *token);                      /* is it one of its arguments? */
bool pm_edit_set(struct pm_edit *e, int word, struct pm_edit_option o, const char *value);    /* NULL: takes it out; false: too long */
void pm_edit_remove(struct pm_edit *e, int word);

/* sentence-numbers.c */
int pm_edit_order(const struct pm_edit *e);  /* of the scheme of its push: 1 if none is known */
int pm_edit_passes(const struct pm_edit *e); /* force evaluations per step */
int pm_edit_setter(const struct pm_edit *e, char value[64]);  /* the push that sets the step; -1 none */
int pm_edit_chooser(const struct pm_edit *e, char value[64]); /* the push of ias15, which chooses its steps by this tolerance; -1 none */
double pm_edit_step(const struct pm_edit *e, const struct pm_frame *f); /* [time] of the sentence, or of the frame; NAN: the word dt sets it */
bool pm_edit_cells(const struct pm_edit *e, const struct pm_frame *f, size_t n[3]); /* of p2m along each axis; false: no p2m, or no mesh */
double pm_edit_points(const struct pm_edit *e, const struct pm_frame *f); /* of that mesh; 0: no p2m */
double pm_edit_cost(const struct pm_edit *e, const struct pm_frame *f, const struct pm_plan *p); /* [ns] of a step, estimated */

#endif
