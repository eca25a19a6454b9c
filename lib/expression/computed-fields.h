/* Fields computed from expressions: what scalc does. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EXPRESSION_COMPUTED_FIELDS_H
#define PM_EXPRESSION_COMPUTED_FIELDS_H

#include "expression/expression-jobs.h"

struct pm_computed_choice { /* of new fields; one that is there keeps its own */
	enum pm_role role;
	enum pm_type type;
	bool extensive;
	const char *unit; /* NULL: as it is */
	bool total;       /* the sum over the particles in place of the value (field-total.h) */
	const char *per;  /* with total: of those with the same value of this field; NULL: of all */
};

/* Header: "NAME = EXPRESSION" on a set or mesh. *changed is set if the field is state. 0 or failure. */
int pm_computed_declare(struct pm_expression_jobs *jobs, const struct pm_computed_choice *c, struct pm_frame *f, const char *on, const char *text,
	bool *changed);
/* Header, where state is changed: what others computed from it is dropped. 0, or failure where it is read. */
int pm_computed_outdate(const struct pm_expression_jobs *jobs, struct pm_frame *f);
/* Data, all ranks. 0, or failure where a whole number does not fit. */
int pm_computed_apply(const struct pm_expression_jobs *jobs, const struct pm_computed_choice *c, struct pm_frame *f);

#endif
