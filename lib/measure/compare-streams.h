/* Two streams compared, the second as the reference: what scmp prints. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_COMPARE_STREAMS_H
#define PM_MEASURE_COMPARE_STREAMS_H

#include <stdio.h>

#include "measure/field-pairs.h"
#include "stream/wire.h"

extern const char *const pm_norm_names[]; /* NULL ends */

struct pm_comparison {
	struct pm_field_pairs_choice choice;
	int norm;         /* in pm_norm_names: the one held against the tolerance */
	double tolerance; /* NAN: none */
	FILE *out;        /* gets the table */
	uint64_t frame;   /* under way, from 1 */
	bool begun, over; /* the line of column names is out; a norm was beyond the tolerance */
};

/* Every frame of both to the end. 0, or failure: they cannot be compared, one is shorter, a norm is beyond the tolerance. */
int pm_compare_streams(struct pm_comparison *c, struct pm_reader *const r[2], const char *const name[2]);

#endif
