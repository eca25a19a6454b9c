/* cycle --until: an expression over the columns of diag that ends a run when it becomes true. NAME0 is a column's value at the beginning of the run.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CYCLE_UNTIL_H
#define PM_CYCLE_UNTIL_H

#include "stream/frame.h"

struct pm_until;

struct pm_until *pm_until_new(const char *text); /* NULL: failure, with the column of the text */
struct pm_until *pm_until_free(struct pm_until *u);
/* At the beginning of a run: stores the values of the NAME0. */
int pm_until_begin(struct pm_until *u, struct pm_frame *f);
/* Those values as JSON, for a checkpoint, and back into a resumed run at frame f; failure if the expression needs one that is missing. */
json_t *pm_until_save(const struct pm_until *u);
int pm_until_load(struct pm_until *u, struct pm_frame *f, const json_t *saved);
/* Is it true for this frame? 1, 0, or failure. Cost: one pass over the fields that the columns need. */
int pm_until_met(struct pm_until *u, struct pm_frame *f);

#endif
