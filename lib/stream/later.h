/* Values that are made when someone asks for them (pm_in, the writer), for a word that runs in one process with the next one: a field that this one needs in
 * pieces, or that no word needs before it is replaced, is never in memory as a whole. The values are those that would have been made at once.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_LATER_H
#define PM_STREAM_LATER_H

#include "stream/frame.h"

/* The first member of what is known of them, a block of malloc. Not where there are ranks. */
struct pm_later {
	int (*make)(const struct pm_later *later, double *to); /* all values, component by component, all finite; 0 or failure. Also says what kind it is */
	struct pm_field *from; /* f64: its values stay as they are now; set by pm_field_later */
};

/* In frame(), for an f64 field that the stage makes: takes `later` over, also when it fails. 0 or failure. */
int pm_field_later(struct pm_field *field, struct pm_later *later, const struct pm_field *from);
/* NULL: the values are there. A stage asks that can do without them, and has said so (PM_USE_LATER). */
const struct pm_later *pm_field_later_of(const struct pm_field *field);

#endif
