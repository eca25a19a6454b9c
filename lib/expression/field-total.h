/* A field of a set becomes its sum over the particles: what scalc --total does. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EXPRESSION_FIELD_TOTAL_H
#define PM_EXPRESSION_FIELD_TOTAL_H

#include "stream/frame.h"

/* Header: the field is of a set and real, `per` (may be NULL) a field of one component, which will be read. 0 or failure. */
int pm_total_declare(struct pm_frame *f, const struct pm_field *field, const char *per);
/* Data: every value becomes the sum of all, or, with `per`, of those with the same value of `per`. All ranks; takes the status, and returns the agreed
 * one. */
int pm_total(int status, const struct pm_frame *f, struct pm_field *field, const char *per);

#endif
