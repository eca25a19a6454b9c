/* All values of a component on every rank, for methods in which every particle may be a partner. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_ALL_VALUES_H
#define PM_STREAM_ALL_VALUES_H

#include "stream/frame.h"

/* all: room for those of the whole set or mesh, in the order of the stream; here: the like->count ones that are here, which may be at their place in `all`
 * already. In a frame that is not divided a copy. Takes a status and returns the agreed one; where it is a failure, nothing is written. */
int pm_all_values(int status, const struct pm_field *like, const double *here, double *all);

#endif
