/* Sums and largest values over a field of a set, in a divided frame over the stretches of all ranks: the same bytes either way. Then all ranks call them, in
 * the same order. For functions that return no status: a rank that cannot go on ends the run. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_OVER_STRETCHES_H
#define PM_STREAM_OVER_STRETCHES_H

#include "base/in-order.h"
#include "stream/frame.h"

/* pm_over_set of base/in-order.h; data: what p->make takes, of the field->count values that are here. */
void pm_over_stretches(const struct pm_field *field, const struct pm_parts *p, const void *data, void *all);
/* pm_sum_of_set in the same way. */
void pm_sum_of_stretches(const struct pm_field *field, const double *x, const double *y, struct pm_sum *all);
/* The largest over all of what is largest here. */
double pm_most_of_stretches(const struct pm_field *field, double here);

#endif
