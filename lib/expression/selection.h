/* Which sets, meshes, fields and particles of a frame stay: what sel does inside a frame. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EXPRESSION_SELECTION_H
#define PM_EXPRESSION_SELECTION_H

#include "stream/frame.h"

struct pm_selection {
	struct pm_names {
		const char *const *name;
		int n;
	} sets, meshes, fields, drop; /* kept; n = 0: all. Fields as NAME or ON/NAME; drop names any of the three */
	const char *where;                /* expression over the particles of a set; NULL: all stay */
};

/* Header: everything named must be there; without `where` what was not chosen goes at once. 0 or failure. */
int pm_selection_declare(const struct pm_selection *s, struct pm_frame *f);
/* Data, with `where` only: keeps the particles for which it is not 0, then leaves out what was not chosen. 0 or failure. */
int pm_selection_apply(const struct pm_selection *s, struct pm_frame *f);

#endif
