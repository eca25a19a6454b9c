/* What cycle writes of a frame. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CYCLE_OUTPUT_H
#define PM_CYCLE_OUTPUT_H

#include "sentence/sentence.h"
#include "stage/selection-options.h"

struct pm_output_choice {
	struct pm_selection_options kept;
	struct pm_list store; /* all, f32 */
};

struct pm_output {
	struct pm_selection kept;
	bool all, single;        /* --store all; f32 */
	struct pm_frame *before; /* the header of the run's first frame until the names have been checked; NULL: they have, or there are none */
};

int pm_output_init(struct pm_output *o, const struct pm_output_choice *c); /* 0 or failure */
/* At the beginning of a run, and at its first full step or its end: the names must exist in one of the two frames. 0 or failure. */
int pm_output_begin(struct pm_output *o, const struct pm_frame *f);
int pm_output_check(struct pm_output *o, const struct pm_frame *f);
/* A frame with what is to be written of f; free it. NULL: failure. */
struct pm_frame *pm_output_of(const struct pm_output *o, struct pm_sentence *words, const struct pm_frame *f);
void pm_output_free(struct pm_output *o);

#endif
