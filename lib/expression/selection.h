/* Which sets, meshes, fields and particles of a frame stay: and which frames of a stream: what sel does. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EXPRESSION_SELECTION_H
#define PM_EXPRESSION_SELECTION_H

#include "stream/frame.h"

struct pm_names {
	const char *const *name;
	int n;
};

struct pm_selection {
	struct pm_names sets, meshes, fields, drop; /* to keep; n = 0: all. Fields as NAME or ON/NAME; drop may name a set, a mesh or a field */
	const char *where;                          /* expression over the particles of a set; NULL: keep all */
};

/* Does every name exist, in one of these frames at least? 0 or failure. */
int pm_selection_check(const struct pm_selection *s, const struct pm_frame *const f[], int n);
/* Removes what was not chosen; names that do not exist here are not missed. */
void pm_selection_leave_out(const struct pm_selection *s, struct pm_frame *f);
/* Header: every name must exist; without `where` everything not chosen is removed at once. 0 or failure. */
int pm_selection_declare(const struct pm_selection *s, struct pm_frame *f);
/* Behind that: can ranks share it? With `where`, if every set that is chosen has values to divide, and every strength is used, because sums are compared. */
bool pm_selection_divides(const struct pm_selection *s, const struct pm_frame *f);
/* Data, only with `where`: keeps the particles for which it is not 0, then removes everything that was not chosen. 0 or failure. */
int pm_selection_apply(const struct pm_selection *s, struct pm_frame *f);

/* Frames by number, counted from 1: N, N:M or N: as typed. Is each of these? 0 or failure. Is this frame one of them (n = 0: all are)? */
int pm_frame_numbers_check(const struct pm_names *ranges);
bool pm_frame_numbers_contain(const struct pm_names *ranges, uint64_t number);

#endif
