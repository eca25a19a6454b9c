/* What was computed from the values of a field is kept with it, as its note, until they change: sums over strengths, quotients of two fields. A result is the
 * same whether it was kept or not. Ranks, who must all do the same, keep nothing. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_KEPT_H
#define PM_STREAM_KEPT_H

#include "stream/frame.h"

/* What was kept under this name (the address of a string of the caller) of a field and, if not NULL, of another one `with`; NULL: nothing, or a value of either
 * has changed since. */
const void *pm_kept(const struct pm_field *field, const struct pm_field *with, const char *name);
/* Keeps it: a block of pm_alloc, which is the field's from now on. False: it is still the caller's; so it is while the running word changes either. */
bool pm_keep(const struct pm_field *field, const struct pm_field *with, const char *name, void *block);

#endif
