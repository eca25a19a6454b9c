/* Smallest, largest and mean value of a field. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_RANGE_H
#define PM_MEASURE_RANGE_H

#include "stream/frame.h"

struct pm_range {
	double min, max, mean;
	double least; /* the smallest above 0, infinite where there is none */
};

/* Of component c, or of the vector's length if c is -1. A field without values gives NAN. The frame has the set or mesh that the field is on.
 * Where ranks share the field all call. */
struct pm_range pm_range_of(const struct pm_frame *f, const struct pm_field *field, int c);
double pm_field_value(const struct pm_field *field, int c, size_t i); /* of any type; c = -1: the length */

#endif
