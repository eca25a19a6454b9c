/* Two streams compared, the second as the reference: what scmp prints. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_COMPARE_STREAMS_H
#define PM_MEASURE_COMPARE_STREAMS_H

#include <stdio.h>

#include "measure/field-pairs.h"
#include "measure/joint-norms.h"
#include "stream/wire.h"

extern const char *const pm_norm_names[]; /* NULL ends */

struct pm_comparison {
	struct pm_field_pairs_choice choice;
	int norm;         /* index in pm_norm_names: the norm compared with the tolerance */
	double tolerance; /* NAN: none */
	FILE *out;        /* gets the table */
	uint64_t frame;   /* under way, from 1 */
	/* pm_joint_declare() and pm_joint_norms() on this frame, by all ranks or here: the norms. */
	int (*joint)(void *stage, struct pm_frame *joint);
	void *stage;
	const struct pm_norms *norms;
	bool begun, over; /* the line of column names has been printed; a norm exceeded the tolerance */
};

/* Compares all frames of both. 0, or failure: they cannot be compared, one is shorter, or a norm exceeds the tolerance. */
int pm_compare_streams(struct pm_comparison *c, struct pm_reader *const r[2], const char *const name[2]);

#endif
